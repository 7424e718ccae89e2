// How near velocities come to a known flow.
#pragma once

#include "cli/orders/exact.h"

namespace mandoline::orders {

struct Speeds {
  double meanError = 0;         ///< of the velocity at the centroids of cells, by volume
  double largestOnSurface = 0;  ///< at the centroids of its faces
};

/// With the exact flow's normal derivative on the sides of the box.
Speeds speedsOf(const CellComplex& cells, const Exact& exact);

}  // namespace mandoline::orders
