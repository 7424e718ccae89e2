// Angles in degrees.
#pragma once

namespace mandoline::operators {

/// From 0 to 180. That of the C library is not the same everywhere.
inline double cosineOfDegrees(double angle) {
  constexpr double kDegree = 0.017453292519943295;
  const double square = angle * kDegree * angle * kDegree;
  double term = 1, sum = 1;
  for (int i = 2; i <= 24; i += 2) sum += term *= -square / double(i * (i - 1));
  return sum;
}

}  // namespace mandoline::operators
