// Polynomials of cells, fitted to one phi after another.
#pragma once

#include "physics/cubic_fits.h"

namespace mandoline::physics {

/// Fits some cells again and again.
class MANDOLINE_SHARED CellFitter {
 public:
  /// `data`: those of `which`, at least; `cubic`: those of them whose polynomials are of degree three, ascending.
  CellFitter(const FitSource& source, FitData data, std::vector<uint32_t> which, std::vector<uint32_t> cubic, detail::Monitor& monitor);

  const FitData& data() const { return data_; }
  const std::vector<uint32_t>& square() const { return which_; }  ///< the cells whose polynomials are of degree two, ascending
  const std::vector<uint32_t>& cubic() const { return cubic_.cells(); }

  /// Those of other cells are zero. Valid until the next call.
  const CellFits& fit(const std::vector<double>& values, const std::vector<double>& source, detail::Monitor& monitor);
  /// What the last call has found; no other one may follow.
  CellFits take() { return std::move(fits_); }

 private:
  const CellComplex& cells_;
  FitData data_;
  std::vector<uint32_t> which_;
  detail::Csr<uint32_t> ids_;  // per cell of which_: its data
  std::vector<FitFactors> factors_;
  CubicFitter cubic_;
  CellFits fits_;
};

}  // namespace mandoline::physics
