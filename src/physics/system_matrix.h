// The matrix of a Poisson system as solving it needs it.
#pragma once

#include <vector>

#include "mandoline/csr_matrix.h"

namespace mandoline::physics {

/// The system's matrix, multiplied by differences of x: except for what conditions and mass add, each row sums to zero. So rounding of a
/// large constant in x does not drown the rest.
class SystemMatrix {
 public:
  /// `added`: per row, its sum.
  SystemMatrix(const CsrMatrix& matrix, const std::vector<double>& added) : matrix_(matrix), added_(added) {}

  double row(const std::vector<double>& x, size_t i) const {
    double sum = added_[i] * x[i];
    forEachOther(i, [&](size_t j, double value) { sum += value * (x[j] - x[i]); });
    return sum;
  }
  void multiply(const std::vector<double>& x, std::vector<double>& result) const {
    for (size_t i = 0; i < x.size(); ++i) result[i] = row(x, i);
  }
  /// Gauss-Seidel, forwards and backwards. The smallest cells hardly show in a residual; this adjusts them to their neighbours.
  void sweep(const std::vector<double>& rhs, std::vector<double>& x) const {
    for (size_t k = 0; k < 2 * x.size(); ++k) {
      const size_t i = k < x.size() ? k : 2 * x.size() - 1 - k;
      double diagonal = added_[i];
      forEachOther(i, [&](size_t, double value) { diagonal -= value; });
      if (diagonal > 0) x[i] += (rhs[i] - row(x, i)) / diagonal;
    }
  }

 private:
  template <class F>
  void forEachOther(size_t i, const F& f) const {
    for (auto e = size_t(matrix_.rowOffsets[i]); e < size_t(matrix_.rowOffsets[i + 1]); ++e) {
      const auto j = size_t(matrix_.entryColumns[e]);
      if (j != i) f(j, matrix_.entryValues[e]);
    }
  }

  const CsrMatrix& matrix_;
  const std::vector<double>& added_;
};

}  // namespace mandoline::physics
