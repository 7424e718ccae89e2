// The arrays of faces, of what has been assembled.
#pragma once

#include "operators/refine/assembly.h"

namespace mandoline::refining {

/// Fills in the arrays of faces and loops of `cells`, with faces of cut-cells first, in the order of levels; and what `cutMesh` has of
/// those alone, but for loops. Its grid is that of the smallest cells. Loops have ids of SharedIds.
void writeFaces(const Assembled& assembled, const Sources& sources, detail::Monitor& monitor, CellComplex& cells, CutMesh& cutMesh);

}  // namespace mandoline::refining
