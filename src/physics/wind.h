// A wind that blows through the box.
#pragma once

#include "base/shared.h"
#include "base/team.h"
#include "mandoline/poisson.h"

namespace mandoline::physics {

/// The components, divided where cells are connected by slits alone: faces with less than a millionth of the area of other faces of both
/// cells. A wind that had to pass through those would be absurdly fast.
MANDOLINE_SHARED CellComponents partsBetweenSlits(const CellComplex& cells, const detail::Team& team = 1);

// The steps of windBoundary(), for cells that several processes have a part of each.

/// Conditions for the potential of a wind that blows through the sides of the box as if nothing were inside.
MANDOLINE_SHARED Boundary freeWind(const CellComplex& cells, const std::array<double, 3>& wind);

/// What the wind brings into each part, and takes out.
struct WindThrough {
  std::vector<double> in, out;
};
/// `cellPart`: per cell; `parts` or more is none, and left out.
MANDOLINE_SHARED WindThrough windThrough(const CellComplex& cells, const Boundary& boundary, std::span<const uint32_t> cellPart,
                                         uint32_t parts);

/// Of the flow through the sides of each component, and of what of that was taken away.
struct WindLost {
  std::vector<double> all, lost;

  MANDOLINE_SHARED std::vector<uint32_t> throttled() const;
};
/// Scales the wind down so that it brings as much into each part as it takes out. What cells of no part have stays as it is.
MANDOLINE_SHARED WindLost throttle(const CellComplex& cells, const WindThrough& wind, std::span<const uint32_t> cellPart,
                                   const CellComponents& components, Boundary& boundary);

/// Conditions for the potential of a wind that blows through the sides of the box, as much into each of these parts as out of it.
/// `throttled` gets the components that the wind is scaled down in.
Boundary windBoundary(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<uint32_t>& throttled,
                      const detail::Team& team = 1);

}  // namespace mandoline::physics
