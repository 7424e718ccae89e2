// Points in a plane, and on which side of each other they lie, exactly.
#pragma once

#include <cmath>

#include "base/shared.h"

namespace mandoline::operators {

struct PlanePoint {
  double x, y;
  bool operator==(const PlanePoint& other) const { return x == other.x && y == other.y; }
};

/// Twice the triangle's area, rounded, but with its exact sign.
MANDOLINE_SHARED double exactOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Twice the triangle's area with an exact sign; positive when a, b, c turn counter-clockwise.
inline double orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  constexpr double kErrorBound = (3 + 16 * 0x1p-53) * 0x1p-53;
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), area = left - right;
  return std::fabs(area) >= kErrorBound * (std::fabs(left) + std::fabs(right)) ? area : exactOrientation(a, b, c);
}

inline double squaredDistance(const PlanePoint& a, const PlanePoint& b) { return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y); }

}  // namespace mandoline::operators
