// The edges of a cut-mesh.
#include <algorithm>

#include "base/csr.h"
#include "base/sort.h"
#include "mandoline/measure.h"
#include "mesh/run_call.h"
#include "operators/cut_input.h"
#include "operators/measure/places.h"

namespace mandoline {

namespace {

/// Per vertex the higher ends of its edges, each as often as a loop runs along it.
detail::Csr<uint32_t> higherEnds(const CutMesh& cutMesh) {
  const auto forEachEdge = [&](const auto& f) {
    for (size_t l = 0; l < cutMesh.loopCount(); ++l) {
      const std::span<const uint32_t> loop = cutMesh.loop(l);
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
        f(std::min(a, b), std::max(a, b));
      }
    }
  };
  detail::Csr<uint32_t> ends;
  ends.offsets.assign(cutMesh.vertexCount() + 1, 0);
  forEachEdge([&](uint32_t low, uint32_t) { ++ends.offsets[low + 1]; });
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) ends.offsets[v + 1] += ends.offsets[v];
  ends.items.resize(ends.offsets.back());
  std::vector<uint32_t> at(ends.offsets.begin(), ends.offsets.end() - 1);
  forEachEdge([&](uint32_t low, uint32_t high) { ends.items[at[low]++] = high; });
  return ends;
}

}  // namespace

CutEdges cutEdges(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options) {
  const operators::CutInput input(mesh, cutMesh);
  return detail::runCall("measuring", [&] {
    detail::Monitor monitor(options, 1);
    monitor.beginStage("edges", 0);
    const measuring::Places places(input.mesh(), cutMesh, monitor);
    detail::Csr<uint32_t> ends = higherEnds(cutMesh);
    CutEdges edges;
    edges.edgeVertices.reserve(ends.items.size());
    edges.edgeLength.reserve(ends.items.size() / 2);
    for (uint32_t low = 0; low < ends.size(); ++low) {
      const std::span<uint32_t> highs = ends[low];
      detail::sortItems(highs);
      const auto end = std::unique(highs.begin(), highs.end());
      for (auto high = highs.begin(); high != end; ++high) {
        edges.edgeVertices.insert(edges.edgeVertices.end(), {low, *high});
        edges.edgeLength.push_back(measuring::length(places.between(low, *high)));
      }
    }
    return edges;
  });
}

}  // namespace mandoline
