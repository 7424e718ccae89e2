// World coordinates within a grid scaled by one power of two, for exact arithmetic (base/exact.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/exact.h"
#include "mandoline/grid.h"

namespace mandoline::operators {

using detail::Predicates;
using ScaledPoint = std::array<double, 3>;

/// Scaled coordinates of what lies in the grid are below 2 and multiples of 2^-252, as smaller ones than 2^-200 become 0 (the cutter's
/// smallest, too): a product of four stays within range. The map is monotone, and the planes of a grid that was cut stay distinct.
class ScaledSpace {
 public:
  explicit ScaledSpace(const Grid& grid) {
    double largest = 0;
    for (const auto& planes : grid.planes) {
      if (!planes.empty()) largest = std::max({largest, std::fabs(planes.front()), std::fabs(planes.back())});
    }
    shift_ = largest > 0 ? -std::ilogb(largest) : 0;
    factor_ = {std::ldexp(1.0, shift_ / 2), std::ldexp(1.0, shift_ - shift_ / 2)};  // a double can't hold 2^1074
    inverse_ = {1 / factor_[0], 1 / factor_[1]};
  }

  double scaled(double x) const {
    x = x * factor_[0] * factor_[1];
    return std::fabs(x) < 0x1p-200 ? 0 : x;
  }
  ScaledPoint scaled(const double* p) const { return {scaled(p[0]), scaled(p[1]), scaled(p[2])}; }
  double world(double x) const { return x * inverse_[0] * inverse_[1]; }
  /// As an exponent of two: scaled = world * 2^shift.
  int shift() const { return shift_; }

 private:
  int shift_;
  std::array<double, 2> factor_, inverse_;
};

}  // namespace mandoline::operators
