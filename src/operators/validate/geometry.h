// The arithmetic of validate(). It repeats, with less speed, what base and the cutter have: a validator that computed with their code would
// not see its mistakes. Containers and loops from base are shared, for a mistake in them would not go unnoticed.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/plain_arithmetic.h"

namespace mandoline::validation {

struct Vec3 {
  double v[3] = {0, 0, 0};
  double& operator[](int d) { return v[d]; }
  double operator[](int d) const { return v[d]; }
};
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}}; }
inline Vec3 operator*(double s, const Vec3& a) { return {{s * a[0], s * a[1], s * a[2]}}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline int dominantAxis(const Vec3& a) {
  const int d = std::fabs(a[1]) > std::fabs(a[0]) ? 1 : 0;
  return std::fabs(a[2]) > std::fabs(a[d]) ? 2 : d;
}

/// What rounding to a double changes at most, relative to its size.
constexpr double kRounding = 0x1p-53;

/// Sum of doubles that loses nothing to cancellation (Neumaier).
class Sum {
 public:
  void add(double x) {
    const double t = sum_ + x;
    lost_ += std::fabs(sum_) >= std::fabs(x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

/// Pseudo-random numbers, the same on every platform (splitmix64).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15u); }
  double between(double low, double high) { return low + (high - low) * double(next() >> 11) * 0x1p-53; }
  static uint64_t mix(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

 private:
  uint64_t state_;
};

/// An exact number of any size: digits times powers of 2^24.
class Exact {
 public:
  Exact() = default;
  Exact(double x);
  Exact operator+(const Exact& other) const { return sum(other, 1); }
  Exact operator-(const Exact& other) const { return sum(other, -1); }
  Exact operator*(const Exact& other) const;
  int sign() const { return digits_.empty() ? 0 : digits_.back() > 0 ? 1 : -1; }
  /// It is the sum of these, the largest first, each at most half of 2^24 of its unit; divided by (2^24)^power.
  size_t termCount() const { return digits_.size(); }
  double term(size_t i, int power) const { return double(digits_[digits_.size() - 1 - i]) * unit(i, power); }
  double unit(size_t i, int power) const { return std::ldexp(1.0, kBits * (end() - 1 - int(i) - power)); }
  /// The power of 2^24 above it.
  int end() const { return exponent_ + int(digits_.size()); }

 private:
  static constexpr int kBits = 24;
  Exact sum(const Exact& other, int64_t sign) const;
  void carry();

  std::vector<int64_t>
      digits_;        // from the lowest, at most half of 2^24 in size either way, so that the highest, which isn't 0, has the sign
  int exponent_ = 0;  // of the lowest: its power
};

/// (a - b) (c - d).
struct Product {
  double a, b, c, d;
};
/// Exact sign of a difference.
int differenceSign(const Product& x, const Product& y);
/// Exact: 1 if a, b, c turn counter-clockwise about +axis.
int turn(const Vec3& a, const Vec3& b, const Vec3& c, int axis);
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);
/// Distance of p from a segment or triangle, at most a few roundings too large however thin the triangle is, if coordinates are in
/// roundings.
double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b);
double distanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
/// Triangle normal (b - a) x (c - a) and a bound of the error of each of its components.
struct Normal {
  Vec3 n, error;
};
Normal normalOf(const Vec3& a, const Vec3& b, const Vec3& c);

using Polygon = std::vector<Vec3>;
/// The part of a polygon where side(p) >= 0, for a side that is linear in p.
template <class Side>
void clip(Polygon& polygon, Side&& side) {
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double sa = side(a), sb = side(b);
    if (sa >= 0) kept.push_back(a);
    if ((sa > 0 && sb < 0) || (sa < 0 && sb > 0)) kept.push_back(a + sa / (sa - sb) * (b - a));
  }
  polygon.swap(kept);
}

inline void clipToBox(Polygon& polygon, const Vec3& low, const Vec3& high) {
  for (int d = 0; d < 3; ++d) {
    clip(polygon, [&](const Vec3& p) { return p[d] - low[d]; });
    clip(polygon, [&](const Vec3& p) { return high[d] - p[d]; });
  }
}

}  // namespace mandoline::validation
