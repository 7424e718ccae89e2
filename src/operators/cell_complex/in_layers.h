// The cells of some layers of the grid.
#pragma once

#include "base/shared.h"
#include "mandoline/cell_complex.h"
#include "mandoline/measure.h"

namespace mandoline::operators {

/// As cellComplex(), of a cut-mesh and octree cells that are complete in these layers of grid cells along z, from the first up to, not
/// including, the second. Others are not there; octree cells that reach out of the layers lack faces and vertices there. Towards other
/// layers, faces have one cell and the tag inner. `measures`: those of the cut-mesh. Arguments are not checked.
MANDOLINE_SHARED CellComplex cellComplexInLayers(Measures measures, const CutMesh& cutMesh, const OctreeCells& octree,
                                                 const std::array<int64_t, 2>& layers, const RunOptions& options);

}  // namespace mandoline::operators
