// The corners of a polygon, linked into cyclic chains.
#pragma once

#include <cstdint>
#include <vector>

#include "operators/triangulate/plane_point.h"

namespace mandoline::operators {

/// A place on a chain. A vertex may have several.
struct Corner {
  static constexpr uint32_t kNone = ~0u;

  PlanePoint at;
  uint32_t vertex, previous, next;
  uint32_t version = 0;           ///< that of its last entry in the ear clipper's heap
  uint32_t firstWatcher = kNone;  ///< ears to look at again when this corner is gone
  bool alive = true;
};

struct Chains {
  static constexpr uint32_t kNone = Corner::kNone;

  std::vector<Corner> corners;
  std::vector<uint32_t> loopFirst;  ///< per loop that was added: its first corner

  const PlanePoint& at(uint32_t i) const { return corners[i].at; }
  uint32_t vertex(uint32_t i) const { return corners[i].vertex; }
  uint32_t previous(uint32_t i) const { return corners[i].previous; }
  uint32_t next(uint32_t i) const { return corners[i].next; }
  double turn(uint32_t a, uint32_t b, uint32_t c) const { return orientation(at(a), at(b), at(c)); }
  void link(uint32_t a, uint32_t b) {
    corners[a].next = b;
    corners[b].previous = a;
  }
  /// f(corner) for all of a corner's chain.
  template <class F>
  void forChain(uint32_t first, const F& f) const {
    uint32_t i = first;
    do {
      f(i);
      i = next(i);
    } while (i != first);
  }
  /// Whether the inside of the polygon at a corner, the wedge to the left of its two edges, opens towards a point.
  bool opensTowards(uint32_t corner, const PlanePoint& p) const {
    const uint32_t before = previous(corner), after = next(corner);
    const bool leftOfNext = orientation(at(corner), at(after), p) > 0, leftOfPrevious = orientation(at(corner), p, at(before)) > 0;
    return turn(before, corner, after) > 0 ? leftOfNext && leftOfPrevious : leftOfNext || leftOfPrevious;
  }
};

}  // namespace mandoline::operators
