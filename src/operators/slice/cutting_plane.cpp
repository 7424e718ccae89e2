#include "operators/slice/cutting_plane.h"

#include "base/double_double.h"
#include "operators/triangulate/exact_sum.h"

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
  const detail::TwoTerms products[] = {
      twoProduct(normal_[0], p[0]), twoProduct(normal_[1], p[1]), twoProduct(normal_[2], p[2]), {-offset_, 0}};
  return detail::signOf(leadingTerm(products));
}

double CuttingPlane::distanceAt(const ScaledPoint& p) const {
  constexpr double kRoundings = 64;
  size_t d = 0;
  while (normal_[d] == 0) ++d;
  DoubleDouble sum = twoProduct(normal_[d], p[d]);
  while (++d < 3) {
    if (normal_[d] != 0) sum += twoProduct(normal_[d], p[d]);
  }
  const double height = double(sum - DoubleDouble(offset_));
  return std::fabs(height) > kRoundings * detail::kRoundoff * sizeAt(p) ? std::fabs(height) : 0;
}

CuttingPlane::Crossing CuttingPlane::crossing(const End& a, const End& b) {
  const bool fromA = a.distance < b.distance || (a.distance == b.distance && a.at < b.at);  // from the nearer end, whichever comes first
  const End &near = fromA ? a : b, &far = fromA ? b : a;
  if (near.distance == 0) return {near.at, fromA ? 0 : 1};
  const double t = near.distance / (near.distance + far.distance);
  Crossing crossing = {{}, -1};
  for (int d = 0; d < 3; ++d) crossing.at[d] = near.at[d] + t * (far.at[d] - near.at[d]);
  return crossing;
}

}  // namespace mandoline::operators
