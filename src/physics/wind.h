// A wind that blows through the box.
#pragma once

#include "mandoline/poisson.h"

namespace mandoline::physics {

/// Conditions for the potential of a wind that blows through the sides of the box, as much into each part as out of it. Parts are
/// components, divided where only slits connect cells. `throttled` gets the components that the wind is scaled down in.
Boundary windBoundary(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<uint32_t>& throttled);

}  // namespace mandoline::physics
