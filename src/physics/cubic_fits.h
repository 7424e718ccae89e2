// In octree cells phi is fitted by polynomials of degree three.
#pragma once

#include "physics/cell_fits.h"

namespace mandoline::physics {

/// Of some cells, ascending, those that are fitted so where there are no coefficients: octree cells larger than grid cells, or beside a
/// larger one; without `besideCut` none beside cut-cells, where polynomials of degree two do as well in corrections. These have second
/// derivatives that are off by first order where cells are not all alike, as at sides of the grid and where sizes meet.
std::vector<uint32_t> cubicCells(const FitSource& source, const std::vector<uint32_t>& cells, bool besideCut);

/// Fits some octree cells again and again, in problems without coefficients.
class CubicFitter {
 public:
  /// `data`: those of the cells, at least; `isReused`: whether more than one fit follows.
  CubicFitter(const FitSource& source, const FitData& data, std::vector<uint32_t> which, bool isReused, detail::Monitor& monitor);

  /// Replaces what is known of these cells. `known`: of the data.
  void fit(const CellFits::Known& known, detail::Monitor& monitor, CellFits& fits) const;

  const std::vector<uint32_t>& cells() const { return which_; }

 private:
  static constexpr size_t kUnknowns = 18;  ///< those of FitEquation, then the third derivatives, times the size squared
  using Factors = SquareFactors<kUnknowns>;
  struct Equation {
    Factors::Row row;
    double along, weight;
  };
  static constexpr size_t kAtOnce = 4;  ///< equations whose values are weighted together
  /// What unknowns follow from: per equation what a value of 1 adds to them, and what a mean second derivative of 1 over the size does.
  struct Weights {
    std::vector<std::array<Factors::Row, kAtOnce>> ofValues;
    Factors::Row ofMean{};
  };

  Equation equationOf(const FitData& data, uint32_t item, uint32_t cell) const;
  Equation derivativeEquation(const FitData& data, uint32_t id, uint32_t cell) const;
  Equation sourceEquation(const FitData& data, uint32_t neighbor, uint32_t cell) const;
  /// What cells have around them, so that it does not depend on where they are.
  struct Shapes {
    detail::Csr<uint32_t> data;  ///< per cell, in an order that follows from keys
    std::vector<uint64_t> keys;  ///< per cell: cells of the same shape, but for rounding, have the same
  };

  bool isOfSeveral(const FitData& data, uint32_t id) const;         // the difference to the mean of phi in several cells
  bool isBetweenPoints(const FitData& data, uint32_t id) const;     // a difference of phi
  Point spreadOnSide(const FitData& data, uint32_t id) const;       // as of spreadOf(), of what is given on a side of an octree cell
  bool hasSources() const { return source_.problem.mass.empty(); }  // a mass changes them from size to size
  void gather(const FitData& data, uint32_t cell, std::vector<uint32_t>& items) const;
  Shapes shapesOf(const FitData& data, unsigned threads) const;
  uint64_t keyOf(const FitData& data, uint32_t id, uint32_t cell) const;
  uint64_t gatherByShape(const FitData& data, const Shapes& shapes, uint32_t cell, std::vector<uint32_t>& items) const;
  void findPatterns(const FitData& data, const std::vector<uint64_t>& keys, unsigned threads);
  Weights weightsOf(const FitData& data, size_t i) const;
  std::vector<Equation> equationsOf(const FitData& data, size_t i) const;
  double valueOf(const CellFits::Known& known, uint32_t item, uint32_t cell) const;
  Factors::Row unknownsOf(const CellFits::Known& known, size_t i) const;
  Factors::Row weighted(const CellFits::Known& known, size_t i, const Weights& weights) const;

  /// In grids of equal spacing many cells have the same weights. More patterns, as other grids may have, are not kept.
  static constexpr size_t kMostPatterns = 16384;
  static constexpr uint32_t kNone = ~uint32_t(0);

  FitSource source_;
  std::vector<uint32_t> which_;
  detail::Csr<uint32_t> items_;     // per cell of which_: data, and the number of all plus neighbours
  std::vector<uint32_t> patterns_;  // per cell of which_
  std::vector<Weights> weights_;    // per pattern
};

}  // namespace mandoline::physics
