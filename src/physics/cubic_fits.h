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

 private:
  static constexpr size_t kUnknowns = 18;  ///< those of FitEquation, then the third derivatives, times the size squared
  using Factors = SquareFactors<kUnknowns>;
  struct Equation {
    Factors::Row row;
    double along, weight;
  };
  /// What unknowns follow from: per equation what a value of 1 adds to them, and what a mean second derivative of 1 over the size does.
  struct Weights {
    std::vector<Factors::Row> ofValues;
    Factors::Row ofMean{};
  };

  Equation equationOf(const FitData& data, uint32_t item, uint32_t cell) const;
  Equation derivativeEquation(const FitData& data, uint32_t id, uint32_t cell) const;
  Equation sourceEquation(const FitData& data, uint32_t neighbor, uint32_t cell) const;
  void gather(const FitData& data, uint32_t cell, std::vector<uint32_t>& items) const;
  uint64_t sortByEquation(const FitData& data, uint32_t cell, std::vector<uint32_t>& items) const;
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
