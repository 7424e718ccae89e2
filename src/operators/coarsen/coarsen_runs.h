// Octree cells of a cut-mesh of which only the runs are known.
#pragma once

#include "base/shared.h"
#include "mandoline/coarsen.h"

namespace mandoline::operators {

/// As coarsen() of the whole, to the bit; of `cutMesh` the grid, the runs and the fingerprint are read.
MANDOLINE_SHARED OctreeCells coarsenRuns(const CutMesh& cutMesh, const CoarsenOptions& options);

}  // namespace mandoline::operators
