// Finds living corners in a box: a k-d tree without pointers, the middle of each range being its node.
#pragma once

#include <cstdint>
#include <vector>

#include "operators/triangulate/chains.h"

namespace mandoline::operators {

class CornerTree {
 public:
  void build(const std::vector<Corner>& corners);
  void remove(uint32_t corner);

  /// The first corner in the box that `blocks`, or kNone.
  template <class Blocks>
  uint32_t find(const std::vector<Corner>& corners, const PlanePoint& low, const PlanePoint& high, const Blocks& blocks) const {
    return findIn(Query<Blocks>{corners, low, high, blocks}, {0, uint32_t(order_.size()), 0});
  }

 private:
  static constexpr uint32_t kNone = Corner::kNone;

  template <class Blocks>
  struct Query {
    const std::vector<Corner>& corners;
    const PlanePoint &low, &high;
    const Blocks& blocks;
  };
  struct Range {
    uint32_t begin, end;
    int axis;

    uint32_t middle() const { return begin + (end - begin) / 2; }
    Range lower() const { return {begin, middle(), 1 - axis}; }
    Range upper() const { return {middle() + 1, end, 1 - axis}; }
  };

  static double coordinate(const PlanePoint& p, int axis) { return axis == 0 ? p.x : p.y; }
  void split(const std::vector<Corner>& corners, const Range& range);
  uint32_t countLiving(const Range& range);

  template <class Blocks>
  uint32_t findIn(const Query<Blocks>& query, const Range& range) const {
    if (range.begin == range.end || living_[range.middle()] == 0) return kNone;
    const uint32_t corner = order_[range.middle()];
    const PlanePoint &p = query.corners[corner].at, &low = query.low, &high = query.high;
    const bool inBox = low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
    if (query.corners[corner].alive && inBox && query.blocks(corner)) return corner;
    const double split = coordinate(p, range.axis);
    uint32_t found = kNone;
    if (coordinate(low, range.axis) <= split) found = findIn(query, range.lower());
    if (found == kNone && split <= coordinate(high, range.axis)) found = findIn(query, range.upper());
    return found;
  }

  std::vector<uint32_t> order_, slot_;
  std::vector<uint32_t> living_;  // per slot: living corners in the range that it is the middle of
};

}  // namespace mandoline::operators
