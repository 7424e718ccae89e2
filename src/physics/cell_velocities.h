// The velocity of a flow in cells.
#pragma once

#include "base/parallel.h"
#include "mandoline/flow.h"
#include "physics/cell_fitter.h"

namespace mandoline::physics {

/// Fills in the flow's velocities and gradients in cells from its phi, which solves the problem.
MANDOLINE_SHARED void fillVelocities(const CellComplex& cells, const PoissonProblem& problem, detail::Monitor& monitor, Flow& flow);
/// The same where dual edges are known, for a problem without coefficients. `fitter`: where some cells have been fitted already, or null;
/// it is used up.
void fillVelocities(const FitSource& source, CellFitter* fitter, detail::Monitor& monitor, Flow& flow);

}  // namespace mandoline::physics
