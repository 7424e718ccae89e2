// Tri-vertices moved onto axial planes before a cut.
#pragma once

#include "mandoline/grid.h"

namespace mandoline::detail {

struct SnappedMesh {
  Mesh mesh;
  uint32_t vertices = 0;  ///< how many were moved
  double largest = 0;     ///< farthest such move, in cells
};

/// Moves each coordinate within the tolerance of a plane (in cells) onto it, the nearest one. Takes any mesh: whether it can be cut is
/// found out later.
SnappedMesh snapped(const MeshView& mesh, const Grid& grid, double tolerance);

}  // namespace mandoline::detail
