// Winding numbers of regions, a part of stage 8.
#pragma once

#include "cut/stages/regions.h"

namespace mandoline::detail {

/// What lies on the two sides of every cut-face.
struct Sides {
  static constexpr uint32_t kNone = ~0u;

  const Stencil& stencil;
  const CutFaces& faces;
  const CutCells& cells;
  std::vector<uint32_t> cell;  ///< per half-face: its cut-cell, or kNone

  Sides(const Stencil& stencil_, const CutFaces& faces_, const CutCells& cells_) : stencil(stencil_), faces(faces_), cells(cells_) {
    cell.assign(2 * faces.size(), kNone);
    for (uint32_t c = 0; c < cells.stencilCells.size(); ++c) {
      for (const uint32_t h : cells.halfFaces[c]) cell[h] = c;
    }
  }
};

/// Sets hasWinding and winding of `regions`, whose regions are known.
void findWinding(const Surface& surface, const Sides& sides, Regions& regions, Predicates& predicates);

}  // namespace mandoline::detail
