// Where a point lies among the axial planes, as one integer per axis: 2 k exactly on plane k, 2 k + 1 strictly between planes k and
// k + 1. This is the paper's (c, b) of 3.2 in one number: c = slab >> 1, and b is set when it is even. -1 and 2 n + 1 lie outside.
// All comparisons with axial planes, and the grid element (cell, face, edge or vertex) that anything lies in, are integer arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace mandoline::detail {

using Slab = std::array<int32_t, 3>;

inline bool onPlane(int32_t slab) { return (slab & 1) == 0; }
inline int planeCount(const Slab& s) { return 3 - (s[0] & 1) - (s[1] & 1) - (s[2] & 1); }
/// Whether it lies on no plane.
inline bool isCell(const Slab& s) { return !onPlane(s[0] & s[1] & s[2]); }

/// The slab that holds the inside of a segment or convex piece whose least and greatest slabs are given; they lie in one closed slab.
inline int32_t slabBetween(int32_t least, int32_t greatest) { return least | int32_t(least != greatest); }
/// Whether both lie in one closed slab.
inline bool inOneSlab(int32_t least, int32_t greatest) { return greatest <= (least | 1) + 1; }
/// The grid element of the inside of a segment that crosses no plane.
inline Slab elementBetween(const Slab& u, const Slab& v) {
  Slab e;
  for (int d = 0; d < 3; ++d) e[d] = slabBetween(std::min(u[d], v[d]), std::max(u[d], v[d]));
  return e;
}

/// Calls f(cell) for the grid cells that have a grid element, by z, then y, then x, until it returns true; whether it did. Cells outside of
/// the grid are among them.
template <class F>
bool findCellAround(const Slab& element, const F& f) {
  for (int32_t z = element[2] - onPlane(element[2]); z <= element[2] + onPlane(element[2]); z += 2) {
    for (int32_t y = element[1] - onPlane(element[1]); y <= element[1] + onPlane(element[1]); y += 2) {
      for (int32_t x = element[0] - onPlane(element[0]); x <= element[0] + onPlane(element[0]); x += 2) {
        if (f(Slab{x, y, z})) return true;
      }
    }
  }
  return false;
}

/// First and last plane strictly between two slabs, least <= greatest; none if first > last.
inline int32_t firstPlaneAfter(int32_t least) { return (least >> 1) + 1; }
inline int32_t lastPlaneBefore(int32_t greatest) { return (greatest - 1) >> 1; }

}  // namespace mandoline::detail
