// What a flow carries.
#pragma once

#include "mandoline/unsteady.h"
#include "physics/flow_cells.h"

namespace mandoline::physics {

/// Adds to `result`, 3 per cell, what flows into each cell of the velocity through the faces between cells, with the flow itself.
/// On a face it is that of the cell which the flow comes from, changed linearly towards the face: by a slope that is limited to twice the
/// difference of the two cells, and to twice that behind (monotonized central differences). It is never outside of the values in the two
/// cells. `gradients`: FlowCells::gradients().
void addAdvection(const CellComplex& cells, const FlowCells& flowCells, const UnsteadyFlow& flow, const std::vector<double>& gradients,
                  std::vector<double>& result);

}  // namespace mandoline::physics
