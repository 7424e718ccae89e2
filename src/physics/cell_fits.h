// In each cell phi is fitted by a polynomial of degree two that satisfies its equation: its Laplacian plus slope . gradient is a source.
#pragma once

#include "base/parallel.h"
#include "physics/fit_data.h"

namespace mandoline::physics {

/// What a datum tells of a cell's polynomial: row * unknowns + along * size * (a third of the source) = value of the datum.
struct FitEquation {
  static constexpr size_t kUnknowns = 8;
  using Row =
      std::array<double, kUnknowns>;  ///< gradient; xx, yy, xy, yz, xz of the second derivatives without their trace, times the size
  Row row;
  double along, weight;
  uint32_t datum;
};

/// That of a cell with this centroid and size. Inline, since fits are a tenth quicker so.
inline FitEquation equationOf(const FitDatum& datum, const double* centroid, double size, uint32_t id) {
  const Point& n = datum.direction;
  double r[3], square = 0, along = 0;
  for (size_t d = 0; d < 3; ++d) r[d] = (datum.point[d] - centroid[d]) / size, square += r[d] * r[d], along += n[d] * r[d];
  const double nearness = 1 / (0.25 + square), weight = datum.weight / (size * size) * nearness * nearness;
  return {{n[0], n[1], n[2], n[0] * r[0] - n[2] * r[2], n[1] * r[1] - n[2] * r[2], n[0] * r[1] + n[1] * r[0], n[1] * r[2] + n[2] * r[1],
           n[0] * r[2] + n[2] * r[0]},
          along,
          weight,
          id};
}

/// The factors of a cell's normal equations. Second derivatives that the data leave open, or nearly, are near zero; so are gradients.
class FitFactors {
 public:
  static constexpr size_t kUnknowns = FitEquation::kUnknowns;
  using Row = FitEquation::Row;

  FitFactors() = default;
  explicit FitFactors(std::span<const FitEquation> equations);
  Row solve(Row right) const;

 private:
  double& at(size_t i, size_t j) { return lower_[i * (i - 1) / 2 + j]; }
  double at(size_t i, size_t j) const { return lower_[i * (i - 1) / 2 + j]; }

  std::array<double, kUnknowns*(kUnknowns - 1) / 2> lower_{};  // below the diagonal, which is 1
  Row pivot_{};
};

struct CellFits {
  std::vector<double> gradient;  ///< 3 per cell, at its centroid
  std::vector<double> second;    ///< 6 per cell: the second derivatives xx, yy, zz, xy, yz, xz

  struct Known {
    const FitData& data;
    const std::vector<double>& values;  ///< fitValues()
    const std::vector<double>& source;  ///< per cell; empty for 0
  };

  CellFits(size_t cellCount, unsigned threads);

  /// From what the equations of a cell of this size have found; `mean`: a third of its Laplacian.
  void set(size_t cell, const FitEquation::Row& unknowns, double size, double mean);
  void fit(const Known& known, uint32_t cell, const FitFactors& factors, std::span<const FitEquation> equations);

  /// The gradient of a cell's polynomial at a point.
  Point gradientAt(const CellComplex& cells, size_t cell, const Point& point) const {
    const double *g = &gradient[3 * cell], *s = &second[6 * cell], *centroid = &cells.cellCentroid[3 * cell];
    const double x = point[0] - centroid[0], y = point[1] - centroid[1], z = point[2] - centroid[2];
    return {g[0] + s[0] * x + s[3] * y + s[5] * z, g[1] + s[3] * x + s[1] * y + s[4] * z, g[2] + s[5] * x + s[4] * y + s[2] * z};
  }
};

/// Fits the cells in `which`.
void fitCells(const CellComplex& cells, std::span<const uint32_t> which, const CellFits::Known& known, detail::Monitor& monitor,
              CellFits& fits);

/// Fits some cells again and again.
class CellFitter {
 public:
  /// `data`: those of `which`, at least.
  CellFitter(const CellComplex& cells, FitData data, std::vector<uint32_t> which, detail::Monitor& monitor);

  const FitData& data() const { return data_; }

  /// Those of other cells are zero. Valid until the next call.
  const CellFits& fit(const std::vector<double>& values, const std::vector<double>& source, detail::Monitor& monitor);

 private:
  const CellComplex& cells_;
  FitData data_;
  std::vector<uint32_t> which_;
  detail::Csr<uint32_t> ids_;  // per cell of which_: its data
  std::vector<FitFactors> factors_;
  CellFits fits_;
};

}  // namespace mandoline::physics
