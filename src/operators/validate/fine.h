// Numbers that know how far off they may be: they decide most signs of exact numbers in a few steps, and what they leave open the exact
// numbers decide (geometry.h). Polynomials are written once for both.
#pragma once

#include <cmath>

#include "operators/validate/geometry.h"

namespace mandoline::validation {

/// More than what products of scaled coordinates lose where they underflow.
constexpr double kUnderflow = 0x1p-1000;
/// Bounds are computed with rounding, too.
constexpr double kOfBounds = 1 + 0x1p-40;

/// A double, and a bound of its distance from the exact number. What overflows has an error that is infinite or NaN.
struct Bounded {
  double value = 0, error = 0;

  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    const double v = a.value + b.value;
    return {v, a.error + b.error + kRounding * std::fabs(v)};
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) {
    const double v = a.value - b.value;
    return {v, a.error + b.error + kRounding * std::fabs(v)};
  }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    const double v = a.value * b.value;
    return {v, std::fabs(a.value) * b.error + a.error * (std::fabs(b.value) + b.error) + kRounding * std::fabs(v) + kUnderflow};
  }
  /// The sign of the exact number, or 0 where that is open.
  int sign() const { return std::fabs(value) > kOfBounds * error ? (value > 0 ? 1 : -1) : 0; }
};

/// The same with twice as many digits: a sum of two doubles, the second of which is at most about a rounding of the
/// first.
class Fine {
 public:
  Fine() = default;
  Fine(double x) : high_(x) {}

  friend Fine operator+(const Fine& a, const Fine& b) {
    const Fine sum = exactSum(a.high_, b.high_);
    const double low = a.low_ + b.low_, rest = sum.low_ + low;
    return rounded(sum.high_, rest, a.error_ + b.error_ + kRounding * (std::fabs(low) + std::fabs(rest)));
  }
  friend Fine operator-(const Fine& a, const Fine& b) { return a + Fine(-b.high_, -b.low_, b.error_); }
  friend Fine operator*(const Fine& a, const Fine& b) {
    if (a.isZero() || b.isZero()) return {};
    const Fine product = exactProduct(a.high_, b.high_);
    const double one = a.high_ * b.low_, other = a.low_ * b.high_, both = one + other, rest = product.low_ + both;
    const double roundings = kRounding * (std::fabs(one) + std::fabs(other) + std::fabs(both) + std::fabs(rest));
    const double errors = a.size() * b.error_ + a.error_ * (b.size() + b.error_);
    return rounded(product.high_, rest, roundings + errors + std::fabs(a.low_ * b.low_) + kUnderflow);
  }
  /// Unknown if b may be 0.
  friend Fine quotient(const Fine& a, const Fine& b) {
    const double least = std::fabs(b.high_) - std::fabs(b.low_) - b.error_;
    if (!(least > 0)) return unknown();
    const double first = a.high_ / b.high_;
    const Fine rest = a - Fine(first) * b;
    const double second = rest.high_ / b.high_;
    const Fine left = rest - Fine(second) * b;
    return rounded(first, second, (left.size() + left.error_) / least + kUnderflow);
  }
  /// Could be any number, so that 0 times it is 0.
  static Fine unknown() { return {0, 0, INFINITY}; }
  /// An exact number divided by (2^24)^power.
  static Fine of(const Exact& x, int power) {
    constexpr size_t kTerms = 6;
    Fine sum;
    for (size_t i = 0; i < x.termCount() && i < kTerms; ++i) sum = sum + Fine(x.term(i, power));
    if (x.sign() != 0) sum.error_ += kUnderflow;
    if (x.termCount() > kTerms) sum.error_ += x.unit(kTerms - 1, power);
    return sum;
  }
  double error() const { return error_; }

  /// Whether the exact number is surely 0.
  bool isZero() const { return high_ == 0 && low_ == 0 && error_ == 0; }
  /// The sum as one double.
  Bounded bounded() const { return {high_ + low_, error_ + kRounding * size()}; }
  /// a - b; nothing is lost.
  static Fine exactDifference(double a, double b) { return exactSum(a, -b); }
  /// a - b, which may be far smaller than either.
  static Bounded difference(const Fine& a, const Fine& b) {
    const double high = a.high_ - b.high_, low = a.low_ - b.low_, value = high + low;
    return {value, a.error_ + b.error_ + kRounding * (std::fabs(high) + std::fabs(low) + std::fabs(value))};
  }

 private:
  Fine(double high, double low, double error) : high_(high), low_(low), error_(error) {}
  double size() const { return std::fabs(high_) + std::fabs(low_); }

  /// Nothing is lost (Knuth).
  static Fine exactSum(double a, double b) {
    const double sum = a + b, ofB = sum - a, ofA = sum - ofB;
    return {sum, (a - ofA) + (b - ofB), 0};
  }
  /// Nothing is lost, unless it over- or underflows (Dekker).
  static Fine exactProduct(double a, double b) {
    constexpr double kHalf = 0x1p27 + 1;
    const double ca = kHalf * a, cb = kHalf * b, aHigh = ca - (ca - a), bHigh = cb - (cb - b), aLow = a - aHigh, bLow = b - bHigh;
    const double product = a * b;
    return {product, aLow * bLow - (((product - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow), 0};
  }
  static Fine rounded(double high, double low, double error) {
    Fine sum = exactSum(high, low);
    sum.error_ = kOfBounds * error;
    return sum;
  }

  double high_ = 0, low_ = 0, error_ = 0;
};

/// The same with half as many digits again: base + rest.
struct Finest {
  double base = 0;
  Fine rest;

  friend Fine operator-(const Finest& a, const Finest& b) { return Fine::exactDifference(a.base, b.base) + (a.rest - b.rest); }
};

}  // namespace mandoline::validation
