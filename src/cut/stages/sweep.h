// A piece of a triangle while it is diced (tri_faces.h): a convex polygon, taken apart by the planes of one axis.
#pragma once

#include <algorithm>
#include <vector>

#include "cut/ids.h"
#include "grid/slab.h"

namespace mandoline::detail {

struct Corner {
  VertexId id;
  Slab slab;
};
using Polygon = std::vector<Corner>;

/// A convex polygon that is cut along an axis, from its lowest vertices up. Its outline ascends from there on two sides, which are walked
/// once for all planes: so a polygon across many planes costs what its pieces cost.
class Sweep {
 public:
  Sweep(const Polygon& polygon, int axis, int32_t least, Polygon& piece, Polygon& floor)
      : polygon_(polygon), axis_(axis), piece_(piece), floor_(floor) {
    while (slab(up_) != least || slab(after(up_)) == least) ++up_;
    down_ = up_;
    while (slab(before(down_)) == least) down_ = before(down_);
    piece_.clear();
    for (size_t i = down_; i != up_; i = after(i)) take(i);
    take(up_);
  }

  /// Where the outline leaves the last plane upwards, counter-clockwise, and where it comes back.
  const Corner& up() const { return polygon_[up_]; }
  const Corner& down() const { return polygon_[down_]; }

  /// Goes on to a plane, which the polygon has been cut at along its outline.
  void climb(int32_t slabOfPlane) {
    while (slab(up_) != slabOfPlane) take(up_ = after(up_));
    base_ = down_;
    while (slab(down_) != slabOfPlane) down_ = before(down_);
  }
  /// The piece below that plane, whose line in the plane has these vertices from up() to down() inside of it.
  const Polygon& below(const Polygon& line) {
    piece_.insert(piece_.end(), line.begin(), line.end());
    for (size_t i = down_; i != base_; i = after(i)) take(i);
    floor_.assign(line.rbegin(), line.rend());
    return piece_;
  }
  /// The piece above that line; what climbs on begins there.
  void beginAbove() {
    piece_.clear();
    take(down_);
    piece_.insert(piece_.end(), floor_.begin(), floor_.end());
    take(up_);
  }
  /// The piece above the last plane.
  const Polygon& rest() {
    for (size_t i = after(up_); i != down_; i = after(i)) take(i);
    return piece_;
  }

 private:
  int32_t slab(size_t i) const { return polygon_[i].slab[axis_]; }
  size_t after(size_t i) const { return i + 1 < polygon_.size() ? i + 1 : 0; }
  size_t before(size_t i) const { return i > 0 ? i - 1 : polygon_.size() - 1; }

  void take(size_t i) { piece_.push_back(polygon_[i]); }

  const Polygon& polygon_;
  const int axis_;
  Polygon &piece_, &floor_;
  size_t up_ = 0, down_ = 0, base_ = 0;
};

}  // namespace mandoline::detail
