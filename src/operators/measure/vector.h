// Vectors of doubles or double-doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace mandoline::measuring {

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vector<double> difference(const Vector<double>& a, const Vector<double>& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vector<double>& a, const Vector<double>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double length(const Vector<double>& v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  if (largest == 0) return 0;
  const double x = v[0] / largest, y = v[1] / largest, z = v[2] / largest;
  return largest * std::sqrt(x * x + y * y + z * z);
}

inline int largestAxis(const Vector<double>& v) {
  int axis = 0;
  for (int d = 1; d < 3; ++d) {
    if (std::fabs(v[d]) > std::fabs(v[axis])) axis = d;
  }
  return axis;
}

}  // namespace mandoline::measuring
