#include <algorithm>
#include <array>

#include "base/csr.h"
#include "mandoline/operators.h"
#include "operators/require_cut_mesh.h"
#include "physics/sparse.h"

namespace mandoline {
namespace {

using physics::assemble;
using physics::Triplets;

/// Calls f(from, to) for each directed edge of a face.
template <class F>
void forEachEdge(const CellComplex& cells, size_t face, const F& f) {
  for (const auto loop : cells.loops(face)) {
    for (size_t i = 0; i < loop.size(); ++i) f(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
  }
}

/// The place of an edge among all.
size_t find(const ComplexEdges& edges, uint32_t low, uint32_t high) {
  size_t first = 0, past = edges.count();
  while (first < past) {
    const size_t middle = first + (past - first) / 2;
    const uint32_t* ends = &edges.vertices[2 * middle];
    if (ends[0] < low || (ends[0] == low && ends[1] < high))
      first = middle + 1;
    else
      past = middle;
  }
  const uint32_t ends[] = {low, high};
  if (first == edges.count() || !std::equal(ends, ends + 2, &edges.vertices[2 * first]))
    operators::refuse("The edges lack that from vertex " + std::to_string(low) + " to " + std::to_string(high) + ".", low);
  return first;
}

void requireEdges(const CellComplex& cells, const ComplexEdges& edges) {
  operators::requireMadeFrom(edges.madeFrom, cells.fingerprint, "The edges are those of other cells.");
  if (edges.vertices.size() % 2 != 0) operators::refuse("The edges have an odd number of vertices.");
  for (size_t i = 0; i < edges.vertices.size(); ++i) {
    if (edges.vertices[i] < cells.vertexCount()) continue;
    operators::refuse("Edge " + std::to_string(i / 2) + " names a vertex that does not exist.", int64_t(i / 2));
  }
}

}  // namespace

ComplexEdges complexEdges(const CellComplex& cells) {
  std::vector<std::array<uint32_t, 2>> all;  // lower vertex first
  all.reserve(cells.loopVertices.size());
  for (size_t f = 0; f < cells.faceCount(); ++f)
    forEachEdge(cells, f, [&](uint32_t from, uint32_t to) { all.push_back({std::min(from, to), std::max(from, to)}); });
  auto higher = detail::groupBy<uint32_t>(
      cells.vertexCount(), all.size(), [&](size_t i) { return size_t(all[i][0]); }, [&](size_t i) { return all[i][1]; });
  ComplexEdges edges;
  edges.madeFrom = cells.fingerprint;
  for (uint32_t low = 0; low < higher.size(); ++low) {
    const std::span<uint32_t> ends = higher[low];
    std::sort(ends.begin(), ends.end());
    for (size_t i = 0; i < ends.size(); ++i) {
      if (i == 0 || ends[i] != ends[i - 1]) edges.vertices.insert(edges.vertices.end(), {low, ends[i]});
    }
  }
  return edges;
}

SparseMatrix cellFaceIncidence(const CellComplex& cells) {
  Triplets entries;
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    const int32_t front = cells.faceCells[2 * f], back = cells.faceCells[2 * f + 1];
    if (front == back) continue;
    if (front >= 0) entries.emplace_back(front, int(f), 1);
    if (back >= 0) entries.emplace_back(back, int(f), -1);
  }
  return assemble(cells.cellCount(), cells.faceCount(), entries);
}

SparseMatrix faceEdgeIncidence(const CellComplex& cells, const ComplexEdges& edges) {
  requireEdges(cells, edges);
  Triplets entries;
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    forEachEdge(cells, f, [&](uint32_t from, uint32_t to) {
      entries.emplace_back(int(f), int(find(edges, std::min(from, to), std::max(from, to))), from < to ? 1 : -1);
    });
  }
  SparseMatrix matrix = assemble(cells.faceCount(), edges.count(), entries);
  matrix.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0; });
  return matrix;
}

SparseMatrix edgeVertexIncidence(const CellComplex& cells, const ComplexEdges& edges) {
  requireEdges(cells, edges);
  Triplets entries;
  for (size_t e = 0; e < edges.count(); ++e) {
    entries.emplace_back(int(e), int(edges.vertices[2 * e]), -1);
    entries.emplace_back(int(e), int(edges.vertices[2 * e + 1]), 1);
  }
  return assemble(edges.count(), cells.vertexCount(), entries);
}

}  // namespace mandoline
