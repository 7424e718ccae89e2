// The length of a vector.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace mandoline::physics {

/// Of any magnitude, and the same bits everywhere: std::hypot() of three overflows on some platforms, and rounds as each likes.
inline double lengthOf(const std::array<double, 3>& v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  if (!(largest > 0) || std::isinf(largest)) return largest;
  const int exponent = std::ilogb(largest);
  double sum = 0;
  for (const double x : v) {
    const double part = std::scalbn(x, -exponent);
    sum += part * part;
  }
  return std::scalbn(std::sqrt(sum), exponent);
}

}  // namespace mandoline::physics
