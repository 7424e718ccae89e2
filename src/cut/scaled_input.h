// The input of a cut as all stages see it: exact doubles, scaled by one power of two.
#pragma once

#include "base/parallel.h"
#include "cut/failure.h"
#include "grid/slab.h"
#include "mandoline/cut.h"
#include "mesh/welded_mesh.h"

namespace mandoline::detail {

/// The welded mesh, snapped onto planes, and the grid's planes.
struct Input : WeldedMesh {
  std::array<std::vector<double>, 3> planes;
  double unscale[2] = {1, 1};  ///< world = scaled * unscale[0] * unscale[1]
  std::vector<Slab> slabs;     ///< per tri-vertex

  int32_t cells(int axis) const { return int32_t(planes[axis].size()) - 1; }
  double toWorld(double scaled) const { return scaled * unscale[0] * unscale[1]; }
  /// Whether a grid element lies in the grid.
  bool inGrid(const Slab& element) const {
    for (int d = 0; d < 3; ++d) {
      if (element[d] < 0 || element[d] > 2 * cells(d)) return false;
    }
    return true;
  }
};

/// What a stage tells about itself while it works.
struct Run {
  CutStats& stats;
  Monitor& monitor;

  void count(const Predicates& predicates) { stats.exactFallbacks += predicates.fallbacks; }
};

}  // namespace mandoline::detail
