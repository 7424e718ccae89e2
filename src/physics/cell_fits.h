// In each cell phi is fitted by a polynomial of degree two that satisfies its equation: its Laplacian plus slope . gradient is a source.
#pragma once

#include "base/parallel.h"
#include "physics/fit_data.h"
#include "physics/least_squares.h"

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
  double r[3], square = 0;
  for (size_t d = 0; d < 3; ++d) r[d] = (datum.point[d] - centroid[d]) / size, square += r[d] * r[d];
  const double nearness = 1 / (0.25 + square), weight = datum.weight / (size * size) * nearness * nearness;
  std::array<double, 6> s = datum.spread;
  for (size_t d = 0; d < 3; ++d)
    s[d] = s[d] / size + n[d] * r[d], s[3 + d] = s[3 + d] / size + n[d] * r[(d + 1) % 3] + n[(d + 1) % 3] * r[d];
  return {{n[0], n[1], n[2], s[0] - s[2], s[1] - s[2], s[3], s[4], s[5]}, s[0] + s[1] + s[2], weight, id};
}

/// The factors of a cell's normal equations. Second derivatives that the data leave open, or nearly, are near zero; so are gradients.
class FitFactors : public SquareFactors<FitEquation::kUnknowns> {
 public:
  FitFactors() = default;
  explicit FitFactors(std::span<const FitEquation> equations) : SquareFactors(equations, 1e-4) {}
};

/// The third derivatives xxx, yyy, zzz, xxy, yyz, zzx, xxz, yyx, zzy, xyz.
using Thirds = std::array<double, 10>;

/// What each of them is multiplied by in the sum over i, j and k of a_i b_j c_k times the derivative ijk.
inline Thirds productOf(const Point& a, const Point& b, const Point& c) {
  Thirds product;
  const auto twice = [&](size_t i, size_t j) { return a[i] * b[i] * c[j] + a[i] * b[j] * c[i] + a[j] * b[i] * c[i]; };
  for (size_t d = 0; d < 3; ++d) {
    product[d] = a[d] * b[d] * c[d];
    product[3 + d] = twice(d, (d + 1) % 3);
    product[6 + d] = twice(d, (d + 2) % 3);
  }
  product[9] = a[0] * (b[1] * c[2] + b[2] * c[1]) + a[1] * (b[0] * c[2] + b[2] * c[0]) + a[2] * (b[0] * c[1] + b[1] * c[0]);
  return product;
}

/// Symmetric: xx, yy, zz, xy, yz, zx.
using Symmetric = std::array<double, 6>;

/// The sum over k of v_k times the third derivatives ijk.
inline Symmetric sumOver(const Thirds& thirds, const Point& v) {
  Symmetric sum;
  for (size_t d = 0; d < 3; ++d) {
    const size_t e = (d + 1) % 3, f = (d + 2) % 3;
    sum[d] = thirds[d] * v[d] + thirds[3 + d] * v[e] + thirds[6 + d] * v[f];
    sum[3 + d] = thirds[3 + d] * v[d] + thirds[6 + e] * v[e] + thirds[9] * v[f];
  }
  return sum;
}
/// v . matrix v.
inline double squareOf(const Symmetric& matrix, const Point& v) {
  double sum = 0;
  for (size_t d = 0; d < 3; ++d) sum += v[d] * (matrix[d] * v[d] + 2 * matrix[3 + d] * v[(d + 1) % 3]);
  return sum;
}

struct CellFits {
  std::vector<double> gradient;  ///< 3 per cell, at its centroid
  std::vector<double> second;    ///< 6 per cell: the second derivatives xx, yy, zz, xy, yz, xz

  struct Known {
    const CellComplex& cells;
    const FitData& data;
    const std::vector<double>& values;  ///< fitValues()
    const std::vector<double>& source;  ///< per cell; empty for 0
  };

  CellFits(size_t cellCount, unsigned threads);

  /// From what the equations of a cell of this size have found; `mean`: a third of its Laplacian.
  void set(size_t cell, const FitEquation::Row& unknowns, double size, double mean);
  /// `ids`: of the equations that the factors are made of.
  void fit(const Known& known, uint32_t cell, const FitFactors& factors, std::span<const uint32_t> ids);

  /// What is known of third derivatives, of some cells.
  std::vector<Thirds> third;
  std::vector<uint32_t> thirdOf;  ///< per cell: its number among these, or kNoThirds; empty if there are none
  const Thirds* thirdsOf(size_t cell) const { return thirdOf.empty() || thirdOf[cell] == kNoThirds ? nullptr : &third[thirdOf[cell]]; }
  static constexpr uint32_t kNoThirds = ~uint32_t(0);

  /// The gradient of a cell's polynomial of degree two at a point.
  Point gradientAt(const CellComplex& cells, size_t cell, const Point& point) const {
    const double *g = &gradient[3 * cell], *s = &second[6 * cell], *centroid = &cells.cellCentroid[3 * cell];
    const double x = point[0] - centroid[0], y = point[1] - centroid[1], z = point[2] - centroid[2];
    return {g[0] + s[0] * x + s[3] * y + s[5] * z, g[1] + s[3] * x + s[1] * y + s[4] * z, g[2] + s[5] * x + s[4] * y + s[2] * z};
  }
};

/// Fits the cells in `which`.
void fitCells(std::span<const uint32_t> which, const CellFits::Known& known, detail::Monitor& monitor, CellFits& fits);

}  // namespace mandoline::physics
