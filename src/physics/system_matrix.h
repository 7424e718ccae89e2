// The matrix of a Poisson system as solving it needs it.
#pragma once

#include <vector>

#include "mandoline/csr_matrix.h"
#include "physics/sweep_order.h"

namespace mandoline::physics {

inline SweepOrder sweepOrderOf(const CsrMatrix& matrix) {
  return {matrix.rows(), [&](size_t i, const auto& visit) {
            for (auto e = size_t(matrix.rowOffsets[i]); e < size_t(matrix.rowOffsets[i + 1]) && size_t(matrix.entryColumns[e]) < i; ++e)
              visit(size_t(matrix.entryColumns[e]));
          }};
}

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
  /// Gauss-Seidel, forwards and backwards. The smallest cells hardly show in a residual; this adjusts them to their neighbours.
  /// `order`: sweepOrderOf(the matrix).
  void sweep(const SweepOrder& order, const std::vector<double>& rhs, std::vector<double>& x, const detail::Team& team) const {
    const auto adjust = [&](size_t i) {
      double diagonal = added_[i];
      forEachOther(i, [&](size_t, double value) { diagonal -= value; });
      if (diagonal > 0) x[i] += (rhs[i] - row(x, i)) / diagonal;
    };
    order.forwards(team, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) adjust(i);
    });
    order.backwards(team, [&](size_t begin, size_t end) {
      for (size_t i = end; i-- > begin;) adjust(i);
    });
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
