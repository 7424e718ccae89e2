// In each cell phi is fitted by a harmonic polynomial of degree two: with the velocity v at the centroid and the symmetric gradient H,
// whose trace is zero, by weighted least squares of n . (v + H r) - value over the data in and around the cell.
#include <algorithm>
#include <cmath>

#include "physics/flow_data.h"

namespace mandoline::physics {
namespace {

constexpr size_t kUnknowns = 8;  // v; xx, yy, xy, yz, xz of H times the cell's size
using Row = std::array<double, kUnknowns>;

/// The normal equations of a least squares problem.
class Fit {
 public:
  void add(const Row& row, double value, double weight) {
    for (size_t i = 0; i < kUnknowns; ++i) {
      for (size_t j = 0; j <= i; ++j) matrix_[i][j] += weight * row[i] * row[j];
      right_[i] += weight * row[i] * value;
    }
  }

  /// Gradients that the data leave open, or nearly, are near zero; so are velocities.
  Row solve() {
    double trace = 0;
    for (size_t i = 0; i < kUnknowns; ++i) trace += matrix_[i][i];
    for (size_t i = 3; i < kUnknowns; ++i) matrix_[i][i] += kTowardsZero * trace;
    for (size_t j = 0; j < kUnknowns; ++j) {  // Cholesky: matrix = L D L^T
      const bool isOpen = !(matrix_[j][j] > 1e-13 * trace);
      pivot_[j] = isOpen ? 0 : 1 / matrix_[j][j];
      for (size_t i = j + 1; i < kUnknowns; ++i) {
        const double factor = matrix_[i][j] * pivot_[j];
        for (size_t k = j + 1; k <= i; ++k) matrix_[i][k] -= factor * matrix_[k][j];
      }
    }
    Row x = right_;
    for (size_t j = 0; j < kUnknowns; ++j) {
      for (size_t i = j + 1; i < kUnknowns; ++i) x[i] -= matrix_[i][j] * pivot_[j] * x[j];
    }
    for (size_t j = kUnknowns; j-- > 0;) {
      x[j] *= pivot_[j];
      for (size_t i = j + 1; i < kUnknowns; ++i) x[j] -= matrix_[i][j] * pivot_[j] * x[i];
    }
    return x;
  }

 private:
  static constexpr double kTowardsZero = 1e-4;

  std::array<Row, kUnknowns> matrix_{};  // lower triangle
  Row right_{}, pivot_{};
};

void addDatum(const FlowDatum& datum, const double* centroid, double size, Fit& fit) {
  const auto& n = datum.normal;
  double r[3], square = 0;
  for (size_t d = 0; d < 3; ++d) r[d] = (datum.point[d] - centroid[d]) / size, square += r[d] * r[d];
  const double nearness = 1 / (0.25 + square), weight = datum.weight / (size * size) * nearness * nearness;
  fit.add({n[0], n[1], n[2], n[0] * r[0] - n[2] * r[2], n[1] * r[1] - n[2] * r[2], n[0] * r[1] + n[1] * r[0], n[1] * r[2] + n[2] * r[1],
           n[0] * r[2] + n[2] * r[0]},
          datum.value, weight);
}

}  // namespace

void fitVelocities(const CellComplex& cells, const FlowData& data, detail::Monitor& monitor, Flow& flow) {
  flow.cellVelocity.resize(3 * cells.cellCount());
  flow.cellGradient.resize(6 * cells.cellCount());
  detail::forChunks<std::vector<uint32_t>>(cells.cellCount(), monitor, [&](std::vector<uint32_t>& ids, size_t begin, size_t end) {
    for (size_t c = begin; c < end; ++c) {
      const double size = data.cellSize[c];
      if (!(size > 0)) continue;
      ids.assign(data.cellData[c].begin(), data.cellData[c].end());
      for (const uint32_t n : data.cellNeighbors[c]) ids.insert(ids.end(), data.cellData[n].begin(), data.cellData[n].end());
      detail::sortUnique(ids);
      Fit fit;
      for (const uint32_t d : ids) addDatum(data.data[d], &cells.cellCentroid[3 * c], size, fit);
      const Row x = fit.solve();
      std::copy(x.begin(), x.begin() + 3, &flow.cellVelocity[3 * c]);
      const double gradient[6] = {x[3], x[4], -x[3] - x[4], x[5], x[6], x[7]};
      for (size_t i = 0; i < 6; ++i) flow.cellGradient[6 * c + i] = gradient[i] / size;
    }
  });
}

}  // namespace mandoline::physics
