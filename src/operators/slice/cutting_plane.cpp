#include "operators/slice/cutting_plane.h"

namespace mandoline::operators {

using detail::DoubleDouble;
using detail::twoProduct;

std::optional<CuttingPlane> CuttingPlane::make(const Plane& plane, const Grid& grid, const ScaledSpace& space) {
  for (const auto& planes : grid.planes) {
    if (planes.empty()) return std::nullopt;
  }
  // Scaled by powers of two: the normal's largest component to 1 .. 2, and normal and offset so that they belong to scaled points.
  CuttingPlane result;
  double largest = 0;
  int steepest = 0;
  for (int d = 0; d < 3; ++d) {
    if (std::fabs(plane.normal[d]) > largest) {
      largest = std::fabs(plane.normal[d]);
      steepest = d;
    }
  }
  const int shift = -std::ilogb(largest);
  for (int d = 0; d < 3; ++d) {
    result.normal_[d] = std::ldexp(plane.normal[d], shift);
    if (std::fabs(result.normal_[d]) < 0x1p-200) result.normal_[d] = 0;  // else products would underflow
  }
  result.offset_ = std::ldexp(plane.offset, shift + space.shift());
  if (std::fabs(result.offset_) > 12) return std::nullopt;  // no coordinate is beyond 2: nothing is that far out

  const bool up = plane.normal[steepest] > 0;
  result.right_ = (steepest + (up ? 1 : 2)) % 3;
  result.up_ = (steepest + (up ? 2 : 1)) % 3;

  ScaledPoint lowest;  // corner of the grid
  for (int d = 0; d < 3; ++d) lowest[d] = space.scaled(result.normal_[d] > 0 ? grid.planes[d].front() : grid.planes[d].back());
  result.onIsAbove_ = result.signAt(lowest) < 0;
  return result;
}

/// Sum of the magnitudes of the terms of normal . p - offset.
double CuttingPlane::sizeAt(const ScaledPoint& p) const {
  return std::fabs(normal_[0] * p[0]) + std::fabs(normal_[1] * p[1]) + std::fabs(normal_[2] * p[2]) + std::fabs(offset_);
}

int CuttingPlane::signAt(const ScaledPoint& p) const {
  // Three products and three sums, each rounded once.
  const double height = normal_[0] * p[0] + normal_[1] * p[1] + normal_[2] * p[2] - offset_;
  if (std::fabs(height) > 8 * detail::kRoundoff * sizeAt(p)) return detail::signOf(height);
  using detail::Expansion;
  return (Expansion(normal_[0]) * Expansion(p[0]) + Expansion(normal_[1]) * Expansion(p[1]) + Expansion(normal_[2]) * Expansion(p[2]) -
          Expansion(offset_))
      .sign();
}

/// In units of the normal's length; 0 where rounding a coordinate could bring the point onto the plane.
double CuttingPlane::distanceAt(const ScaledPoint& p) const {
  constexpr double kRoundings = 64;
  const double height =
      double(twoProduct(normal_[0], p[0]) + twoProduct(normal_[1], p[1]) + twoProduct(normal_[2], p[2]) - DoubleDouble(offset_));
  return std::fabs(height) > kRoundings * detail::kRoundoff * sizeAt(p) ? std::fabs(height) : 0;
}

CuttingPlane::Crossing CuttingPlane::crossing(const ScaledPoint& a, const ScaledPoint& b) const {
  const double distanceA = distanceAt(a), distanceB = distanceAt(b);
  const bool fromA = distanceA < distanceB || (distanceA == distanceB && a < b);  // from the nearer end, the same whichever comes first
  if (std::min(distanceA, distanceB) == 0) return {fromA ? a : b, fromA ? 0 : 1};
  const ScaledPoint &near = fromA ? a : b, &far = fromA ? b : a;
  const double t = std::min(distanceA, distanceB) / (distanceA + distanceB);
  Crossing crossing = {{}, -1};
  for (int d = 0; d < 3; ++d) crossing.at[d] = near[d] + t * (far[d] - near[d]);
  return crossing;
}

}  // namespace mandoline::operators
