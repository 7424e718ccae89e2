// Stage 7, cut-cells (paper, 3.5 and 4.4): joins the half-faces of each grid cell of the stencil into cut-cells.
//
// In: Surface, Stencil, CutFaces. Out: CutCells. After it every half-face inside the grid that faces a grid cell of the stencil
// belongs to exactly one cut-cell; a cut-cell has one outer shell, and the cavities and floating sheets inside of that.
#pragma once

#include <vector>

#include "cut/stages/cut_faces.h"

namespace mandoline::detail {

struct CutCells {
  Csr<HalfFace> halfFaces;             ///< per cut-cell
  std::vector<uint32_t> stencilCells;  ///< per cut-cell: its grid cell, as index into Stencil::cells; ascending
};

CutCells makeCutCells(const Surface& surface, const Stencil& stencil, const CutFaces& faces, Run& run);

}  // namespace mandoline::detail
