// Random coordinates and points that are hard for predicates: on a lattice, where coincidences are exact and common; rounded onto lines
// and planes, which they miss by little; and at both ends of the range that the cutter scales its input to (see grid/scaled_space.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "base/point.h"

enum class Kind { lattice, largeLattice, smallLattice, random, sparse, large, small, wide };
inline constexpr Kind kKinds[] = {Kind::lattice, Kind::largeLattice, Kind::smallLattice, Kind::random,
                                  Kind::sparse,  Kind::large,        Kind::small,        Kind::wide};

class Sampler {
 public:
  using Point = mandoline::detail::Point;
  static constexpr double kLimit = 0x1p121, kFlushBelow = 0x1p-80;  // the range

  explicit Sampler(Kind kind, uint64_t seed = 1) : kind_(kind), random_(seed) {}

  uint64_t below(uint64_t n) { return random_() % n; }
  bool oneIn(uint64_t n) { return below(n) == 0; }
  double unit() { return double(random_() >> 11) * 0x1p-53; }  // the same everywhere, unlike std::uniform_real_distribution

  double coordinate() {
    const double x = oneIn(2) ? 1 + unit() : -1 - unit();
    switch (kind_) {
      case Kind::lattice:
        return double(below(10));
      case Kind::largeLattice:
        return double(below(10)) * 0x1p117;
      case Kind::smallLattice:
        return double(below(10)) * kFlushBelow;
      case Kind::random:
        return x;
      case Kind::sparse: {  // expansions of neighbouring powers of two
        const double more = 1 + std::ldexp(1, -1 - int(below(52)));
        return more - std::ldexp(1, -1 - int(below(52)));
      }
      case Kind::large:
        return x * 0x1p120;
      case Kind::small:
        return x * kFlushBelow;
      case Kind::wide:
        break;
    }
    return std::ldexp(x, int(below(201)) - 80);
  }
  Point point() { return {coordinate(), coordinate(), coordinate()}; }

  /// Into the range.
  static double allowed(double x) {
    return std::fabs(x) < kFlushBelow ? 0 : std::fabs(x) < kLimit ? x : std::copysign(std::nextafter(kLimit, 0.0), x);
  }
  /// Mostly itself, else a neighbour.
  double nudged(double x) { return allowed(oneIn(4) ? std::nextafter(x, oneIn(2) ? kLimit : -kLimit) : x); }
  Point nudged(const Point& p) { return {nudged(p[0]), nudged(p[1]), nudged(p[2])}; }

  /// -1 .. 2, often in eighths, which keep a lattice's points exact.
  double parameter() { return oneIn(3) ? 3 * unit() - 1 : double(below(25)) / 8 - 1; }
  Point onLine(const Point& a, const Point& b) { return combined(a, b, b, parameter(), 0); }
  Point onPlane(const Point& a, const Point& b, const Point& c) {
    const double s = parameter(), t = parameter();  // in this order with every compiler
    return combined(a, b, c, s, t);
  }
  /// a + s (b - a) + t (c - a), rounded.
  static Point combined(const Point& a, const Point& b, const Point& c, double s, double t) {
    Point p;
    for (int d = 0; d < 3; ++d) p[d] = allowed(a[d] + s * (b[d] - a[d]) + t * (c[d] - a[d]));
    return p;
  }

 private:
  Kind kind_;
  std::mt19937_64 random_;
};
