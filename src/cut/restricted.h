// A part of a cut-mesh: that of a box of its grid cells.
#pragma once

#include "cut/stages/brick_grid.h"
#include "mandoline/cut_mesh.h"

namespace mandoline::detail {

/// The planes of one axis that bound the cells of a box, of those of all cells.
std::vector<double> planesOf(const std::vector<double>& planes, const BrickBox& box, size_t axis);

/// The cells in the box, with the faces and vertices that they have, in the same order. Grid and regions are those of the box. The
/// fingerprints are left out.
CutMesh restrictedTo(const BrickBox& box, const CutMesh& cutMesh);

}  // namespace mandoline::detail
