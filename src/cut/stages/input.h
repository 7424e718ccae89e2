// Stage 1, input (paper, Algorithm 1 and Appendix A "Bad Input Meshes"): checks the mesh and the grid, finds every tri-vertex's slabs,
// welds identical positions, drops triangles without area.
//
// In: the user's mesh, grid and snap tolerance. Out: Input, or a Failure that names the offending element.
// After it: all coordinates are finite and scaled by one power of two, so that polynomials of them up to degree 7 neither overflow nor
// underflow; triangles refer to welded vertices; kept triangles have area, so far as exact arithmetic can tell.
#pragma once

#include "cut/scaled_input.h"

namespace mandoline::detail {

Input prepareInput(const MeshView& mesh, const Grid& grid, double snapTolerance, Run& run);

}  // namespace mandoline::detail
