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
  Condition surface;  ///< what is given on the surface
};

extern const Exact kLinear, kManufactured, kHeld, kRobin, kSphereFlow;

/// Robin conditions have a coefficient of 2.
PoissonProblem problemOf(const CellComplex& cells, const Exact& exact, DualPoints points);

struct Errors {
  double mean = 0, largest = 0;
};
/// Of phi at the dual points, less the mean error of each component that has only derivatives.
Errors errorsOf(const CellComplex& cells, const Exact& exact, DualPoints points, const std::vector<double>& phi);
/// Of the derivatives along normals at the centroids of faces between two cells.
Errors faceErrorsOf(const CellComplex& cells, const Exact& exact, const Solution& solution);
/// Of those on the surface.
Errors surfaceErrorsOf(const CellComplex& cells, const Exact& exact, const Boundary& boundary, const Solution& solution);

}  // namespace mandoline::orders
