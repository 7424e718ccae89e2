// A wind that blows through the box.
#pragma once

#include "mandoline/poisson.h"

namespace mandoline::physics {

/// The components, divided where cells are connected by slits alone: faces with less than a millionth of the area of other faces of both
/// cells. A wind that had to pass through those would be absurdly fast.
CellComponents partsBetweenSlits(const CellComplex& cells);

/// Conditions for the potential of a wind that blows through the sides of the box, as much into each of these parts as out of it.
/// `throttled` gets the components that the wind is scaled down in.
Boundary windBoundary(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<uint32_t>& throttled);

}  // namespace mandoline::physics
