// Where rounding errors of what is given leave phi open.
#pragma once

#include "physics/poisson_setup.h"

namespace mandoline::physics {

/// Cells, ascending, in which phi may be wrong by more than `limit`: they exchange so little with others that the rounding errors of what
/// flows into them through the boundary make such a difference. `setup.problem` has the values of the boundary.
std::vector<uint32_t> unresolvedCells(const PoissonSetup& setup, double limit, const detail::Team& team);

}  // namespace mandoline::physics
