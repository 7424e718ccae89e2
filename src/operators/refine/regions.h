// The regions of refined cells, which are those of the grid's cut.
#pragma once

#include "operators/refine/assembly.h"

namespace mandoline::refining {

/// Per cell: its region in the grid's cut. `cells` has faces, with loops in ids of SharedIds, and volumes; `cutMesh` the triangles of
/// faces.
std::vector<uint32_t> findRegions(const CellComplex& cells, const CutMesh& cutMesh, const Assembled& assembled, const Sources& sources);

}  // namespace mandoline::refining
