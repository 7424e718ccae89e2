// A grid cell and what its half-faces are made of, for cut_cells.h.
#pragma once

#include "cut/stages/cell_halves.h"

namespace mandoline::detail {

struct CellView {
  const BrickSurface& surface;
  const Stencil& stencil;
  const CutFaces& faces;
  const CellHalves& halves;
};

}  // namespace mandoline::detail
