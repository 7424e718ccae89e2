// The velocity of a flow in cells.
#pragma once

#include "base/parallel.h"
#include "mandoline/flow.h"

namespace mandoline::physics {

/// Fills in the flow's velocities and gradients in cells from its phi, which solves the problem.
MANDOLINE_SHARED void fillVelocities(const CellComplex& cells, const PoissonProblem& problem, detail::Monitor& monitor, Flow& flow);

}  // namespace mandoline::physics
