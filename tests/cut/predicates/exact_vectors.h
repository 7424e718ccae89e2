// Points in rational numbers, and what predicates ask of them by definition.
#pragma once

#include <array>

#include "base/point.h"
#include "rational.h"
#include "vectors.h"

namespace exact_vectors {

using namespace mandoline::detail;
using namespace vectors;

using Vector = std::array<Rational, 3>;

inline Vector exact(const Point& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

inline std::array<Vector, 3> exact(const std::array<Point, 3>& t) { return {exact(t[0]), exact(t[1]), exact(t[2])}; }

/// Twice the signed area of a, b, c, seen along an axis.
inline Rational area(const Vector& a, const Vector& b, const Vector& c, int axis) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  return (b[p] - a[p]) * (c[q] - a[q]) - (b[q] - a[q]) * (c[p] - a[p]);
}

/// Where a grid line along g crosses the plane of a triangle; p has its other two coordinates. False if it is parallel.
inline bool meetLine(const std::array<Vector, 3>& t, int g, Vector& p) {
  const Vector normal = cross(t[1] - t[0], t[2] - t[0]);
  if (normal[g].sign() == 0) return false;
  const int e = (g + 1) % 3, f = (g + 2) % 3;
  p[g] = t[0][g] - (normal[e] * (p[e] - t[0][e]) + normal[f] * (p[f] - t[0][f])) / normal[g];
  return true;
}

inline bool isInside(const std::array<Vector, 3>& t, int g, const Vector& p) {
  const int side = area(t[0], t[1], p, g).sign();
  return side != 0 && side == area(t[1], t[2], p, g).sign() && side == area(t[2], t[0], p, g).sign();
}

/// Angles about a -> b, counted from the half-plane of one tip, by half turn and cross product: positively scaled along each of its axes.
struct Angles {
  struct Direction {
    Rational x, y;
    bool isSecondHalf() const { return y.sign() < 0 || (y.sign() == 0 && x.sign() < 0); }
  };
  Vector origin, xAxis, yAxis;

  Angles(const Vector& a, const Vector& b, const Vector& tip) : origin(a) {
    yAxis = cross(b - a, tip - a);
    xAxis = cross(yAxis, b - a);
  }
  Direction of(const Vector& tip) const {
    const Vector t = tip - origin;
    return {dot(t, xAxis), dot(t, yAxis)};
  }
  static int compare(const Direction& s, const Direction& t) {
    if (s.isSecondHalf() != t.isSecondHalf()) return s.isSecondHalf() ? 1 : -1;
    return -(s.x * t.y - s.y * t.x).sign();
  }
};

}  // namespace exact_vectors
