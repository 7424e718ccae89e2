// Stage 1, input (paper, Algorithm 1 and Appendix A "Bad Input Meshes"): checks the mesh and the grid, finds every tri-vertex's slabs,
// welds identical positions, drops triangles without area.
//
// In: the user's mesh, grid and snap tolerance. Out: Input, or a Failure that names the offending element.
// After it: all coordinates are finite and scaled by one power of two, so that polynomials of them up to degree 7 neither overflow nor
// underflow; triangles refer to welded vertices; kept triangles have area, so far as exact arithmetic can tell.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "cut/failure.h"
#include "grid/slab.h"
#include "mandoline/mandoline.h"

namespace mandoline::detail {

enum class TriangleState : uint8_t { kept, zeroArea, duplicate };

/// A welded edge whose inside carries vertices of dropped triangles without area; neighbours on both sides share them ("stitching").
struct Stitch {
  uint32_t low, high;              ///< the edge's ends, low < high
  std::vector<uint32_t> vertices;  ///< strictly between, in order from low to high
};

struct Input {
  std::array<std::vector<double>, 3> planes;       ///< scaled
  double unscale[2] = {1, 1};                      ///< world = scaled * unscale[0] * unscale[1]
  std::vector<Point> points;                       ///< per tri-vertex, scaled and snapped
  std::vector<Slab> slabs;                         ///< per tri-vertex
  std::vector<std::array<uint32_t, 3>> triangles;  ///< welded tri-vertices, per input triangle
  std::vector<TriangleState> states;               ///< per input triangle
  std::vector<Stitch> stitches;                    ///< sorted by (low, high)

  bool kept(size_t triangle) const { return states[triangle] == TriangleState::kept; }
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

Input prepareInput(const MeshView& mesh, const Grid& grid, double snapTolerance, CutStats& stats, Monitor& monitor);

}  // namespace mandoline::detail
