#include "base/disjoint_sets.h"
#include "mesh/resolve/arrangement.h"

namespace mandoline::detail {

uint32_t countCurves(std::span<const InnerEdge> edges, size_t vertices) {
  if (edges.empty()) return 0;
  DisjointSets curves(vertices);
  uint32_t count = 0;
  std::vector<uint8_t> seen(vertices, 0);
  for (const auto& [low, high] : edges) {
    for (const uint32_t v : {low, high}) {
      count += !seen[v];
      seen[v] = 1;
    }
    if (curves.find(low) == curves.find(high)) continue;
    curves.unite(low, high);
    --count;
  }
  return count;
}

}  // namespace mandoline::detail
