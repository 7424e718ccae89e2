// What is known of the gradient of phi: the differences of phi between dual points, and what is given on the boundary.
#pragma once

#include "base/csr.h"
#include "mandoline/poisson.h"
#include "physics/cell_coefficients.h"

namespace mandoline::physics {

using Point = std::array<double, 3>;

inline Point pointAt(const std::vector<double>& points, size_t i) { return {points[3 * i], points[3 * i + 1], points[3 * i + 2]}; }

inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Where the derivative of phi in a direction is known. It weighs as much as the area that it holds for.
struct FitDatum {
  Point point, direction;
  double length;  ///< that a difference is divided by
  double weight;
};

struct FitData {
  std::vector<FitDatum> data;           ///< one per dual edge, then one per half-face of the boundary
  detail::Csr<uint32_t> cellData;       ///< per cell, ascending
  detail::Csr<uint32_t> cellNeighbors;  ///< per cell, ascending: those whose data also tell of phi in it
  std::vector<double> cellSize;         ///< per cell: of the distance between dual points
  std::vector<double> slope;            ///< as in CellCoefficients
};

/// Nothing is known along the dual edges of cells where the coefficient jumps.
FitData fitData(const CellComplex& cells, const DualEdges& dual, const PoissonProblem& problem, const CellCoefficients& coefficients = {});

/// The derivatives, per datum.
std::vector<double> fitValues(const CellComplex& cells, const DualEdges& dual, const PoissonProblem& problem, const FitData& fit,
                              const std::vector<double>& phi);

}  // namespace mandoline::physics
