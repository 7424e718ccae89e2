// Least squares for vectors.
#pragma once

#include <array>
#include <cstddef>

namespace mandoline::physics {

/// A sum of weight * r r^T, factored to find the x that solves it times x = right. Where the sum leaves a direction open, x is zero in it.
class Symmetric3 {
 public:
  void add(const std::array<double, 3>& r, double weight) {
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j <= i; ++j) m_[i][j] += weight * r[i] * r[j];
    }
  }

  /// `towardsZero`: relative to the trace, what is added to the diagonal.
  std::array<double, 3> solve(const std::array<double, 3>& right, double towardsZero) const {
    std::array<std::array<double, 3>, 3> m = m_;
    std::array<double, 3> x = right, pivot{};
    const double trace = m[0][0] + m[1][1] + m[2][2];
    for (size_t j = 0; j < 3; ++j) m[j][j] += towardsZero * trace;
    for (size_t j = 0; j < 3; ++j) {  // Cholesky: L D L^T
      pivot[j] = m[j][j] > 1e-13 * trace ? 1 / m[j][j] : 0;
      for (size_t i = j + 1; i < 3; ++i) {
        const double factor = m[i][j] * pivot[j];
        for (size_t k = j + 1; k <= i; ++k) m[i][k] -= factor * m[k][j];
        x[i] -= factor * x[j];
      }
    }
    for (size_t j = 3; j-- > 0;) {
      x[j] *= pivot[j];
      for (size_t i = j + 1; i < 3; ++i) x[j] -= m[i][j] * pivot[j] * x[i];
    }
    return x;
  }

 private:
  std::array<std::array<double, 3>, 3> m_{};  // lower triangle
};

}  // namespace mandoline::physics
