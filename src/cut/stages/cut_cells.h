// Stage 7, cut-cells (paper, 3.5 and 4.4): joins the half-faces of each grid cell of the stencil into cut-cells.
//
// In: Stencil, TriFaces, GridFaces. Out: CutCells. After it every half-face inside of the grid that faces a grid cell of the stencil
// belongs to exactly one cut-cell; a cut-cell has one outer shell, and the cavities and floating sheets inside of that.
#pragma once

#include <vector>

#include "cut/stages/grid_faces.h"

namespace mandoline::detail {

struct CutCells {
  Csr<uint32_t> halfFaces;             ///< per cut-cell: 2 * face + side; faces of TriFaces first, then those of GridFaces
  std::vector<uint32_t> stencilCells;  ///< per cut-cell: its grid cell, as index into Stencil::cells; ascending
};

CutCells makeCutCells(const Input& input, const TriEdges& edges, const Stencil& stencil, const TriFaces& triFaces,
                      const GridFaces& gridFaces, const CutVertices& vertices, CutStats& stats, Monitor& monitor);

}  // namespace mandoline::detail
