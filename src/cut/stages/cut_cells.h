// Cut-cells (paper, 3.5 and 4.4): joins the half-faces of each grid cell of the stencil into cut-cells.
//
// In: Stencil, CutFaces. Out: CutCells of a brick. After it every half-face that faces a grid cell of the stencil belongs to exactly one
// cut-cell; a cut-cell has one outer shell, and the cavities and floating sheets inside of that.
#pragma once

#include <vector>

#include "cut/stages/edge_table.h"
#include "cut/stages/parted_cell.h"
#include "cut/stages/plain_links.h"

namespace mandoline::detail {

/// The cut-cells on both sides of a face, or kNone. Side 0 of a tri-cut-face first; of what lies in a grid-face, the one below its plane.
struct FaceSides {
  static constexpr CellId kNone{~0u};

  CellId cells[2] = {kNone, kNone};
};

struct CutCells {
  Csr<HalfFace, CellId> halfFaces;
  IdVector<CellId, GridCellId> gridCells;  ///< ascending
  std::vector<FaceSides> ofTriFaces;       ///< as the stencil has those in its cells
  std::vector<FaceSides> ofGridFaces;      ///< as GridFaces has their half-faces

  size_t size() const { return gridCells.size(); }
};

/// What making cut-cells needs room for; the same for all bricks of a thread.
struct CellScratch {
  Predicates predicates;
  CellHalves halves;
  EdgeTable table;
  Shells shells;
  std::vector<EdgeTable::Use> around;
  PartedCell parted;
  PlainLinks plain;
  bool onlyGeneral = false;               ///< without parted_cell.h and plain_links.h
  IdVector<LocalHalf, uint8_t> anchored;  ///< per root: whether a half-face of a grid-face is joined to it
  IdVector<LocalHalf, uint32_t> cellOf;   ///< among the cut-cells of the grid cell
  std::vector<uint32_t> ends;             ///< per cut-cell: number of its half-faces, then where the next one goes
};

/// Replaces `cells`, whose memory is used again.
void makeCutCells(const BrickSurface& surface, const Stencil& stencil, const CutFaces& faces, CellScratch& scratch, CutCells& cells);

}  // namespace mandoline::detail
