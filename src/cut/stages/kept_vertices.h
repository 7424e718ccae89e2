// Vertices of the result that lie where they did, with what the cut before has of them.
//
// In: KeptBricks, and the Numbers of both cuts. Out: KeptVertices: those on grid elements that only kept bricks have.
#pragma once

#include "cut/stages/numbers.h"

namespace mandoline::detail {

struct KeptVertices {
  /// Vertices with numbers in a row, now and before.
  struct Run {
    uint32_t first, before, count;

    uint32_t past() const { return first + count; }
  };
  std::vector<Run> runs;            ///< ascending, apart from each other. Empty if no vertex is kept
  const CutMesh* before = nullptr;  ///< the arrays of vertices before

  /// Calls f(first, past) for the parts of a range of numbers that are not kept.
  template <class F>
  void forOthers(size_t first, size_t past, const F& f) const {
    auto run = std::upper_bound(runs.begin(), runs.end(), first, [](size_t at, const Run& r) { return at < r.past(); });
    for (; run != runs.end() && run->first < past; ++run) {
      if (first < run->first) f(first, size_t(run->first));
      first = run->past();
    }
    if (first < past) f(first, past);
  }
};

/// Calls f(array, entries per vertex) for the arrays of a cut-mesh that have its vertices.
template <class F>
void forVertexArrays(const F& f) {
  f(&CutMesh::positions, size_t(3));
  f(&CutMesh::vertexCell, size_t(3));
  f(&CutMesh::vertexParents, size_t(2));
  f(&CutMesh::vertexTriVertex, size_t(1));
  f(&CutMesh::vertexMask, size_t(1));
}

/// Of the cut before: what is left of it once bricks and seams are kept.
struct VerticesBefore {
  const Bricks& bricks;
  const IdVector<BrickId, BrickSeams>& seams;
  const Numbers& numbers;
};

/// KeptVertices::runs.
std::vector<KeptVertices::Run> findKeptVertices(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut,
                                                const Numbers& numbers);

}  // namespace mandoline::detail
