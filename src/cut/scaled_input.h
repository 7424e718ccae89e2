// The input of a cut as all stages see it: exact doubles, scaled by one power of two.
#pragma once

#include "cut/ids.h"
#include "grid/slab.h"
#include "mandoline/cut.h"
#include "mesh/prepared.h"

namespace mandoline::detail {

/// The prepared mesh, and the grid's planes.
struct Input {
  const Prepared* mesh = nullptr;
  std::array<std::vector<double>, 3> planes;
  IdVector<VertexId, Slab> slabs;      ///< per tri-vertex and made vertex
  std::vector<int32_t> cornerWinding;  ///< at the grid's lowest corner, of each of countedOf(mesh): see corner_winding.h

  bool kept(TriangleId t) const { return mesh->kept(t); }
  std::array<VertexId, 3> verticesOf(TriangleId t) const { return mesh->verticesOf(t); }
  /// Of a tri-vertex; near a made vertex.
  const Point& point(VertexId v) const { return mesh->point(v); }
  Ids<TriangleId> triangleIds() const { return mesh->triangleIds(); }

  int32_t cells(int axis) const { return int32_t(planes[axis].size()) - 1; }
  /// Whether a grid element lies in the grid.
  bool inGrid(const Slab& element) const {
    for (int d = 0; d < 3; ++d) {
      if (element[d] < 0 || element[d] > 2 * cells(d)) return false;
    }
    return true;
  }
};

/// Where a stage reports its counts and its progress.
struct Run {
  CutStats& stats;
  Monitor& monitor;
  bool onlyGeneral = false;  ///< for tests: whether stages leave out their short cuts, which changes nothing in the result

  void count(const Predicates& predicates) { stats.exactFallbacks += predicates.fallbacks; }
};

}  // namespace mandoline::detail
