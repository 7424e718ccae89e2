#include "operators/validate/input_topology.h"

#include <algorithm>

namespace mandoline::validation {
namespace {

/// A triangle by its welded vertices in ascending order, and whether that turns it over.
struct Triple {
  std::array<uint32_t, 3> v;
  uint32_t triangle;
  int32_t orientation;
};

Triple tripleOf(const Context& context, uint32_t triangle) {
  Triple triple{{}, triangle, 1};
  for (size_t i = 0; i < 3; ++i) triple.v[i] = context.weld[context.mesh.triangles[3 * size_t(triangle) + i]];
  const auto order = [&](size_t i, size_t j) {
    if (triple.v[i] > triple.v[j]) std::swap(triple.v[i], triple.v[j]), triple.orientation = -triple.orientation;
  };
  order(0, 1), order(1, 2), order(0, 1);
  return triple;
}

void findDuplicates(const Context& context, InputTopology& topology) {
  const std::vector<uint32_t>& droppedTriangles = context.cut.droppedTriangles;
  if (std::none_of(droppedTriangles.begin(), droppedTriangles.end(), [&](uint32_t t) { return context.hasArea(t); })) return;
  std::vector<Triple> triples(context.mesh.triangleCount());
  for (uint32_t t = 0; t < triples.size(); ++t) triples[t] = tripleOf(context, t);
  std::sort(triples.begin(), triples.end(),
            [](const Triple& a, const Triple& b) { return a.v != b.v ? a.v < b.v : a.triangle < b.triangle; });
  topology.multiplicity.assign(triples.size(), 1);
  topology.duplicate.assign(triples.size(), 0);
  for (size_t begin = 0, end = 0; begin < triples.size(); begin = end) {
    int32_t sum = 0;
    bool kept = false;
    for (; end < triples.size() && triples[end].v == triples[begin].v; ++end) {
      sum += triples[end].orientation;
      kept |= !context.dropped[triples[end].triangle];
    }
    for (size_t i = begin; i < end; ++i) {
      const uint32_t t = triples[i].triangle;
      topology.multiplicity[t] = sum * triples[i].orientation;
      topology.duplicate[t] = context.dropped[t] && (kept || i > begin);
    }
  }
}

/// How a triangle runs through an edge of the input.
struct EdgeUse {
  uint64_t edge;  // both welded vertices, the lower one above
  int32_t direction;
  bool isDuplicate, hasArea;
};

struct EdgeUses {
  std::vector<EdgeUse> uses;
  std::vector<uint8_t> onFlat;  // per tri-vertex: corner of a triangle that only its positions flatten
};

EdgeUses collectEdges(const Context& context, const InputTopology& topology) {
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
      if (a != b) result.uses.push_back({edge, a < b ? 1 : -1, topology.isDuplicate(t), hasArea});
    }
  }
  return result;
}

void findClosed(const Context& context, InputTopology& topology) {
  EdgeUses edges = collectEdges(context, topology);
  std::vector<EdgeUse>& uses = edges.uses;
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.edge < b.edge; });
  for (size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    int32_t sum[2] = {0, 0}, withArea[2] = {0, 0};
    for (; end < uses.size() && uses[end].edge == uses[begin].edge; ++end) {
      for (int with = uses[end].isDuplicate ? 1 : 0; with < 2; ++with) {
        sum[with] += uses[end].direction;
        withArea[with] += uses[end].hasArea ? uses[end].direction : 0;
      }
    }
    const bool flat = edges.onFlat[uses[begin].edge >> 32] && edges.onFlat[uint32_t(uses[begin].edge)];
    for (int with = 0; with < 2; ++with) {
      topology.mayBeOpen[with] |= sum[with] != 0 || withArea[with] != 0;
      topology.mayBeClosed[with] &= sum[with] == 0 || flat;
    }
  }
}

}  // namespace

InputTopology findTopology(const Context& context) {
  InputTopology topology;
  findDuplicates(context, topology);
  findClosed(context, topology);
  return topology;
}

}  // namespace mandoline::validation
