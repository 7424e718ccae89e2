// The factors of small normal equations.
#pragma once

#include <array>
#include <cstddef>

namespace mandoline::physics {

/// Several numbers that the same is done to, which takes processors little longer than one.
template <size_t K>
struct Pack {
  std::array<double, K> of{};

  Pack& operator*=(double factor) {
    for (double& x : of) x *= factor;
    return *this;
  }
  Pack& operator-=(const Pack& other) {
    for (size_t k = 0; k < K; ++k) of[k] -= other.of[k];
    return *this;
  }
  friend Pack operator*(double factor, Pack pack) { return pack *= factor; }
};

/// Of N unknowns. Those after the first three that the data leave open, or nearly, are near zero; so are the first three.
template <size_t N>
class SquareFactors {
 public:
  using Row = std::array<double, N>;

  SquareFactors() = default;
  /// Of the equations' rows and weights; `towardsZero`: what is added to the diagonal, relative to its sum.
  template <class Equations>
  SquareFactors(const Equations& equations, double towardsZero) {
    std::array<Row, N> matrix{};  // lower triangle
    for (const auto& equation : equations) {
      const Row& row = equation.row;
      for (size_t i = 0; i < N; ++i) {
        const double factor = equation.weight * row[i];
        for (size_t j = 0; j <= (i | 1); ++j) matrix[i][j] += factor * row[j];  // in pairs, as processors add
      }
    }
    double trace = 0;
    for (size_t i = 0; i < N; ++i) trace += matrix[i][i];
    for (size_t i = 3; i < N; ++i) matrix[i][i] += towardsZero * trace;
    for (size_t j = 0; j < N; ++j) {  // Cholesky: matrix = L D L^T
      const bool isOpen = !(matrix[j][j] > 1e-13 * trace);
      pivot_[j] = isOpen ? 0 : 1 / matrix[j][j];
      for (size_t i = j + 1; i < N; ++i) {
        const double factor = at(i, j) = matrix[i][j] * pivot_[j];
        for (size_t k = j + 1; k <= i; ++k) matrix[i][k] -= factor * matrix[k][j];
      }
    }
  }

  /// Of doubles, or of packs.
  template <class T>
  std::array<T, N> solve(std::array<T, N> x) const {
    for (size_t i = 0; i < N; ++i) {
      for (size_t j = 0; j < i; ++j) x[i] -= at(i, j) * x[j];
    }
    for (size_t j = N; j-- > 0;) {
      x[j] *= pivot_[j];
      for (size_t i = j + 1; i < N; ++i) x[j] -= at(i, j) * x[i];
    }
    return x;
  }

 private:
  double& at(size_t i, size_t j) { return lower_[i * (i - 1) / 2 + j]; }
  double at(size_t i, size_t j) const { return lower_[i * (i - 1) / 2 + j]; }

  std::array<double, N*(N - 1) / 2> lower_{};  // below the diagonal, which is 1
  Row pivot_{};
};

}  // namespace mandoline::physics
