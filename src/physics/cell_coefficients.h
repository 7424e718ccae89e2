// How the coefficient of a problem changes in cells.
#pragma once

#include "mandoline/poisson.h"
#include "physics/dual_edges.h"

namespace mandoline::physics {

/// From the coefficients on those faces of a cell through which something can flow. All empty if the coefficient is 1 everywhere.
struct CellCoefficients {
  std::vector<double> value;  ///< per cell, at its centroid
  std::vector<double> slope;  ///< 3 per cell: the gradient of the coefficient's logarithm
  std::vector<char> jumps;    ///< per cell: whether it has faces with coefficients that differ by more than a half
};

CellCoefficients cellCoefficients(const CellComplex& cells, const DualEdges& dual, const Boundary& boundary);

}  // namespace mandoline::physics
