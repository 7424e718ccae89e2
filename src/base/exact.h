// Two number types that predicates are written for once: Bounded decides nearly every sign in a few flops, Expansion decides the rest.
//
// Bounded carries a double and a proven bound on its error. Expansion is exact: a sum of doubles that do not overlap (Shewchuk 1997,
// "Adaptive precision floating-point arithmetic and fast robust geometric predicates"). Input must be scaled so that no product
// overflows or underflows. Needs plain IEEE arithmetic: compile with -ffp-contract=off.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/big.h"
#include "base/error_free.h"
#include "base/shared.h"

namespace mandoline::detail {

inline constexpr double kRoundoff = 0x1p-53;

inline int signOf(double x) { return (x > 0) - (x < 0); }

/// A double and a bound on its distance from the true value.
struct Bounded {
  double value = 0, error = 0;

  Bounded() = default;
  explicit Bounded(double v) : value(v) {}
  Bounded(double v, double e) : value(v), error(e) {}

  static Bounded difference(double a, double b) {
    const TwoTerms d = twoDiff(a, b);
    return {d.high, std::fabs(d.low)};
  }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    const double v = a.value + b.value;
    return {v, a.error + b.error + kRoundoff * std::fabs(v)};
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) {
    const double v = a.value - b.value;
    return {v, a.error + b.error + kRoundoff * std::fabs(v)};
  }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    const double v = a.value * b.value;
    return {v, std::fabs(a.value) * b.error + std::fabs(b.value) * a.error + a.error * b.error + kRoundoff * std::fabs(v)};
  }
  Bounded operator-() const { return {-value, error}; }
  /// The error is infinite if b may be 0.
  friend Bounded quotient(const Bounded& a, const Bounded& b) {
    const double v = a.value / b.value, room = std::fabs(b.value) - b.error;
    if (!(room > 0)) return {0, INFINITY};
    return {v, ((a.error + std::fabs(v) * b.error) / room + kRoundoff * std::fabs(v)) * (1 + 0x1p-30)};
  }

  /// Whether sign() is proven. Rounding the errors themselves changes them by some 2^-50, far less than the factor allows.
  bool certain() const { return std::fabs(value) > error * (1 + 0x1p-30) || error == 0; }
  int sign() const { return signOf(value); }
};

/// An exact number: a sum of non-overlapping doubles in order of growing magnitude, without zeros.
class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(double v) { push(v); }

  static Expansion difference(double a, double b) {
    const TwoTerms d = twoDiff(a, b);
    Expansion e;
    e.push(d.low);
    e.push(d.high);
    return e;
  }
  friend Expansion operator+(const Expansion& a, const Expansion& b) { return sum(a, b, 1); }
  friend Expansion operator-(const Expansion& a, const Expansion& b) { return sum(a, b, -1); }
  friend Expansion operator*(const Expansion& a, const Expansion& b);
  Expansion operator-() const {
    Expansion e = *this;
    for (double& t : e.terms_) t = -t;
    return e;
  }

  bool certain() const { return true; }
  int sign() const { return terms_.empty() ? 0 : signOf(terms_.back()); }
  /// The nearest double, up to one or two roundings.
  double estimate() const;
  /// The quotient as a double, within a few units in the last place.
  static double quotient(const Expansion& numerator, const Expansion& denominator);

 private:
  void push(double v) {
    if (v != 0) terms_.push_back(v);
  }
  static Expansion sum(const Expansion& a, const Expansion& b, double signOfB);
  static Expansion scale(const Expansion& a, double b);

  std::vector<double> terms_;
};

/// A point in a plane.
struct Point2 {
  double x, y;
};

/// Shewchuk's static filter for turns of differences rounded once: (3 + 16 u) u times the sum of the products' magnitudes.
inline constexpr double kTurnError = (3 + 16 * kRoundoff) * kRoundoff;

/// Whether it is sure, in doubles, that a, b, c turn counter-clockwise.
inline bool surelyTurnsLeft(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  return left - right > kTurnError * (std::fabs(left) + std::fabs(right));
}

/// Evaluates exact signs and counts how many could not be decided in plain doubles. One per thread.
class Predicates {
 public:
  uint64_t fallbacks = 0;

  /// Sign of (b - a) x (c - a) in the plane; positive when a, b, c turn counter-clockwise.
  MANDOLINE_SHARED int orient2d(const Point2& a, const Point2& b, const Point2& c);
  /// Sign of det(b - a, c - a, d - a): positive when d lies on the side of triangle (a, b, c) that its normal points to.
  MANDOLINE_SHARED int orient3d(const double* a, const double* b, const double* c, const double* d);

  /// Sign of a polynomial, given as a callable that works on either number type: f(Number tag) -> Number.
  template <class Polynomial>
  int sign(const Polynomial& f) {
    const Bounded fast = f(Bounded());
    if (fast.certain()) return fast.sign();
    ++fallbacks;
    return f(Big()).sign();
  }
};

}  // namespace mandoline::detail
