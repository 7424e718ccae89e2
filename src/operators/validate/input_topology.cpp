#include "operators/validate/input_topology.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::validation {
namespace {

/// In which direction a triangle has an edge of the input.
struct EdgeUse {
  uint64_t edge;  // both welded vertices, the lower one above
  int32_t direction;
  bool hasArea;
};

struct EdgeUses {
  std::vector<EdgeUse> uses;
  std::vector<uint8_t> onFlat;  // per tri-vertex: corner of a triangle that only its positions flatten
};

EdgeUses collectEdges(const Context& context) {
  const MeshView& mesh = context.mesh;
  EdgeUses result;
  result.onFlat.assign(mesh.vertexCount(), 0);
  result.uses.reserve(mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const bool hasArea = context.hasArea(t);
    const auto cornerOf = [&](size_t i) { return context.weld[mesh.triangles[3 * size_t(t) + i % 3]]; };
    const bool flat = !hasArea && cornerOf(0) != cornerOf(1) && cornerOf(1) != cornerOf(2) && cornerOf(2) != cornerOf(0);
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = cornerOf(i), b = cornerOf(i + 1);
      if (flat) result.onFlat[a] = 1;
      const uint64_t edge = uint64_t(std::min(a, b)) << 32 | std::max(a, b);
      if (a != b) result.uses.push_back({edge, a < b ? 1 : -1, hasArea});
    }
  }
  return result;
}

}  // namespace

InputTopology findTopology(const Context& context) {
  EdgeUses edges = collectEdges(context);
  std::vector<EdgeUse>& uses = edges.uses;
  detail::sortItems(uses, [](const EdgeUse& a, const EdgeUse& b) { return a.edge < b.edge; });
  InputTopology topology;
  for (size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    int32_t sum = 0, withArea = 0;
    for (; end < uses.size() && uses[end].edge == uses[begin].edge; ++end) {
      sum += uses[end].direction;
      withArea += uses[end].hasArea ? uses[end].direction : 0;
    }
    const bool flat = edges.onFlat[uses[begin].edge >> 32] && edges.onFlat[uint32_t(uses[begin].edge)];
    topology.mayBeOpen |= sum != 0 || withArea != 0;
    topology.mayBeClosed &= sum == 0 || flat;
  }
  return topology;
}

}  // namespace mandoline::validation
