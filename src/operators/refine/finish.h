// The cell complex and its cut-mesh, of what has been assembled.
#pragma once

#include "operators/refine/regions.h"

namespace mandoline::refining {

/// But for fingerprints. `grid`: that of the smallest cells.
RefinedCells finish(Assembled assembled, const Sources& sources, Grid grid, detail::Monitor& monitor);

}  // namespace mandoline::refining
