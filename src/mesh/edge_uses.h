// The triangles at each edge of a mesh, without more than a sorted list.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/sort.h"

namespace mandoline::detail {

using Corners = std::array<uint32_t, 3>;

inline bool hasThreeVertices(const Corners& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

/// A side of a triangle.
struct EdgeUse {
  uint32_t low, high;  ///< the edge's ends, low < high
  uint32_t side;       ///< 3 * triangle + i for the side (i, i + 1)
  bool upwards;        ///< whether it leads from the lower end to the higher

  uint32_t triangle() const { return side / 3; }
  bool sameEdge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// Those of all triangles with three different vertices, of so many; ascending by edge, then by side.
inline std::vector<EdgeUse> edgeUses(const std::vector<Corners>& triangles, size_t vertices) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (!hasThreeVertices(triangles[t])) continue;
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), 3 * t + i, a < b});
    }
  }
  sortByKeys(
      uses, vertices, [](const EdgeUse& use) { return use.low; }, [](const EdgeUse& a, const EdgeUse& b) { return a.high < b.high; });
  return uses;
}

/// Calls f(uses of an edge) for each edge, ascending.
template <class F>
void forEachEdge(std::span<EdgeUse> uses, const F& f) {
  for (size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].sameEdge(uses[begin])) ++end;
    f(uses.subspan(begin, end - begin));
  }
}

}  // namespace mandoline::detail
