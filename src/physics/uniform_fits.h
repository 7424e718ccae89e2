// The fits of cells in the midst of a uniform grid. They all have the same data around them, so the weights of phi are found once.
#pragma once

#include "physics/cell_fits.h"

namespace mandoline::physics {

class UniformFits {
 public:
  /// Without coefficients. `source` must outlive this.
  UniformFits(const FitSource& source, unsigned threads);

  /// The cells elsewhere, ascending.
  std::vector<uint32_t> otherCells() const;
  /// Fits those of the uniform grid, to their rounding as fitCells() does.
  void fit(const std::vector<double>& phi, unsigned threads, CellFits& fits) const;

 private:
  static constexpr size_t kSides = 6;  ///< 2 * axis + (0 for the lower one, 1 for the upper one)
  static constexpr size_t kNodes = 24;
  static constexpr uint32_t kNone = ~uint32_t(0);
  using Row = FitEquation::Row;
  using Neighbors = std::array<uint32_t, kSides>;

  void findSteps();
  Neighbors neighborsOf(size_t cell) const;
  bool isStep(size_t cell, size_t other, size_t side) const;
  bool isEven(size_t cell) const { return cell >= cells_.cutCells && neighbors_[cell - cells_.cutCells][0] != kNone; }
  bool isUniform(size_t cell) const;
  void findWeights();
  std::array<uint32_t, kNodes> nodesOf(size_t cell) const;

  const CellComplex& cells_;
  const FitSource source_;
  Point step_{};                      // between grid cells
  std::vector<Neighbors> neighbors_;  // per octree cell: those across its sides, or none if not all are as in a uniform grid
  std::array<Row, kNodes> weights_;   // per node: what the unknowns are for a difference of 1 from it to the cell, of grid cells
  Row ofMean_{};                      // the same for a third of the source
};

}  // namespace mandoline::physics
