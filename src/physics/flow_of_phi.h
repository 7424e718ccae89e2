// A potential flow that another solver has found.
#pragma once

#include "base/shared.h"
#include "mandoline/flow.h"

namespace mandoline::physics {

/// What follows from its phi, which solves the system without corrections. The wind has a length that doubles can have.
MANDOLINE_SHARED Flow flowOfPhi(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<double> phi,
                                const RunOptions& options);

}  // namespace mandoline::physics
