// Problems with known solutions.
#pragma once

#include "mandoline/poisson.h"

namespace mandoline::orders {

using Point = std::array<double, 3>;

/// phi where it is needed: anywhere near the cells.
struct Exact {
  double (*phi)(const Point&);
  Point (*gradient)(const Point&);
  double (*laplacian)(const Point&);
  bool surfaceStops;  ///< the exact surface has the normal derivative 0, and the triangles are only near it
  bool sidesHeld;     ///< phi is given on the sides of the grid, not its derivative
};

extern const Exact kLinear, kManufactured, kSphereFlow;

PoissonProblem problemOf(const CellComplex& cells, const Exact& exact, DualPoints points);

/// Of phi at the dual points, less the mean error of each component that has only derivatives.
struct Errors {
  double mean = 0, largest = 0;
};
Errors errorsOf(const CellComplex& cells, const Exact& exact, DualPoints points, const std::vector<double>& phi);

}  // namespace mandoline::orders
