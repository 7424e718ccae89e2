// What one plane makes of a polygon of few corners, with less walking than a Sweep.
#pragma once

#include <bit>
#include <memory>

#include "cut/stages/polygon.h"

namespace mandoline::detail {

/// What pieces are made in.
struct HalvesRoom {
  CornerRow inner, outer, line;
  std::unique_ptr<HalvesRoom> next;

  /// For pieces of the pieces.
  HalvesRoom& deeper() {
    if (!next) next = std::make_unique<HalvesRoom>();
    return *next;
  }
};

/// A convex polygon that has been cut at a plane along its outline, with corners on both sides of it.
class PolygonHalves {
 public:
  static constexpr size_t kMostCorners = 64;

  PolygonHalves(Polygon polygon, size_t axis, int32_t slabOfPlane) : polygon_(polygon) {
    uint64_t on = 0;  // a bit for each corner
    for (size_t i = polygon.size(); i-- > 0;) on = on << 1 | uint64_t(polygon[i].slab[axis] == slabOfPlane);
    first_ = size_t(std::countr_zero(on));
    last_ = size_t(std::bit_width(on)) - 1;
    isInnerAbove_ = polygon[first_ + 1].slab[axis] > slabOfPlane;
  }

  /// Where the outline leaves the plane upwards, counter-clockwise, and where it comes back.
  const Corner& up() const { return polygon_[isInnerAbove_ ? first_ : last_]; }
  const Corner& down() const { return polygon_[isInnerAbove_ ? last_ : first_]; }

  struct Pieces {
    Polygon below, above;
  };
  /// The pieces beside the line in the room, which leads from up() to down(), or has nothing if there is nothing between.
  Pieces pieces(HalvesRoom& room) const {
    const Polygon line = room.line.all();
    room.outer.begin(polygon_.size() + line.size());
    room.outer.addBlocks(&polygon_[last_], polygon_.size() - last_);
    room.outer.addBlocks(&polygon_[0], first_ + 1);
    Polygon inner = polygon_.subspan(first_, last_ - first_ + 1);
    if (line.size() > 2) {
      room.inner.begin(inner.size() + line.size());
      room.inner.addBlocks(inner.data(), inner.size());
      join(line, isInnerAbove_ ? room.outer : room.inner, isInnerAbove_ ? room.inner : room.outer);
      inner = room.inner.all();
    }
    return isInnerAbove_ ? Pieces{room.outer.all(), inner} : Pieces{inner, room.outer.all()};
  }

 private:
  static void join(Polygon line, CornerRow& below, CornerRow& above) {
    for (size_t i = 1; i + 1 < line.size(); ++i) {
      below.add(line[i]);
      above.add(line[line.size() - 1 - i]);
    }
  }

  const Polygon polygon_;
  size_t first_, last_;  // of the corners in the plane
  bool isInnerAbove_;    // whether those between them lie above it
};

}  // namespace mandoline::detail
