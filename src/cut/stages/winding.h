// Winding numbers and parity of regions: the second half of regions.h.
#pragma once

#include "cut/stages/regions.h"

namespace mandoline::detail {

/// What lies on the two sides of every cut-face.
class Sides {
 public:
  static constexpr CellId kNone{~0u};

  const Stencil& stencil;
  const CutFaces& faces;
  const CutCells& cells;
  Sides(const Stencil& stencil_, const CutFaces& faces_, const CutCells& cutCells) : stencil(stencil_), faces(faces_), cells(cutCells) {
    cells_.assign(2 * faces.size(), kNone);
    for (const CellId c : cells.gridCells.ids()) {
      for (const HalfFace h : cells.halfFaces[c]) cells_[h.number] = c;
    }
  }
  /// The cut-cell of a half-face, or kNone.
  CellId cell(HalfFace halfFace) const { return cells_[halfFace.number]; }

 private:
  std::vector<CellId> cells_;  // per half-face
};

/// Sets winding numbers and parity of `regions`, whose regions are known.
void findWinding(const Surface& surface, const Sides& sides, Regions& regions, Predicates& predicates);

}  // namespace mandoline::detail
