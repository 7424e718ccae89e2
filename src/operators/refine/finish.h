// The cell complex and its cut-mesh, of what has been assembled.
#pragma once

#include "operators/refine/assembly.h"

namespace mandoline::refining {

/// What there is of the leaves.
struct Sources {
  const OctreeCells& leaves;
  const Parts& parts;
  const SharedIds& ids;
  const CutMesh& whole;  ///< the cut of the grid
};

/// But for fingerprints. `grid`: that of the smallest cells.
RefinedCells finish(Assembled assembled, const Sources& sources, Grid grid);

}  // namespace mandoline::refining
