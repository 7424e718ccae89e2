// What is known of the gradient of phi: the differences of phi between dual points, and what is given on the boundary.
#pragma once

#include "base/csr.h"
#include "mandoline/poisson.h"
#include "physics/cell_coefficients.h"

namespace mandoline::physics {

using Point = std::array<double, 3>;

inline constexpr Point kAxes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

inline Point pointAt(const std::vector<double>& points, size_t i) { return {points[3 * i], points[3 * i + 1], points[3 * i + 2]}; }

inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Where the derivative of phi in a direction is known. It weighs as much as the area that it holds for.
struct FitDatum {
  Point point, direction;
  double length;  ///< that a difference is divided by
  double weight;
  std::array<double, 6> spread;  ///< of the mean of several points: what second derivatives xx, yy, zz, xy, yz, xz add, per length
};

struct FitData {
  std::vector<uint32_t> ids;            ///< per datum, ascending: its dual edge, or the number of these plus its half-face of the boundary
  std::vector<FitDatum> data;           ///< those of some cells and their neighbours
  detail::Csr<uint32_t> cellData;       ///< per cell, ascending
  detail::Csr<uint32_t> cellNeighbors;  ///< per such cell: those whose data also tell of phi in it; a few may be named twice
  std::vector<double> cellSize;         ///< per cell: of the distance between dual points
  std::vector<double> slope;            ///< as in CellCoefficients
};

/// What a problem is made of, as data are found in it.
struct FitSource {
  const CellComplex& cells;
  const DualEdges& dual;
  const detail::Csr<uint32_t>& edgesOfCells;  ///< cellEdges()
  const PoissonProblem& problem;
};

/// Those of the cells in `which`, ascending, or of all if it is null. Nothing is known along the dual edges of cells where the coefficient
/// jumps.
FitData fitData(const FitSource& source, const std::vector<uint32_t>* which, const CellCoefficients& coefficients, unsigned threads);

/// The derivatives, per datum.
std::vector<double> fitValues(const FitSource& source, const FitData& fit, const std::vector<double>& phi, unsigned threads);

}  // namespace mandoline::physics
