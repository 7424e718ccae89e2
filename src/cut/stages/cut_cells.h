// Cut-cells (paper, 3.5 and 4.4): joins the half-faces of each grid cell of the stencil into cut-cells.
//
// In: Surface, Stencil, CutFaces. Out: CutCells. After it every half-face inside the grid that faces a grid cell of the stencil
// belongs to exactly one cut-cell; a cut-cell has one outer shell, and the cavities and floating sheets inside of that.
#pragma once

#include <vector>

#include "cut/stages/cut_faces.h"

namespace mandoline::detail {

struct CutCells {
  Csr<HalfFace, CellId> halfFaces;
  IdVector<CellId, GridCellId> gridCells;  ///< ascending

  size_t size() const { return gridCells.size(); }
};

CutCells makeCutCells(const Surface& surface, const Stencil& stencil, const CutFaces& faces, Run& run);

}  // namespace mandoline::detail
