// Double-double arithmetic: a number as the unevaluated sum of two doubles, some 106 bits (Dekker 1971). For coordinates and
// measures, where an error of 2^-100 is nothing; signs that decide take exact.h.
#pragma once

#include "base/error_free.h"

namespace mandoline::detail {

struct DoubleDouble {
  double high = 0, low = 0;  // low is at most half a unit in the last place of high

  DoubleDouble() = default;
  DoubleDouble(double value) : high(value) {}
  DoubleDouble(const TwoTerms& terms) : high(terms.high), low(terms.low) {}
  explicit operator double() const { return high; }
};

inline DoubleDouble operator-(const DoubleDouble& a) { return TwoTerms{-a.high, -a.low}; }

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = twoSum(a.high, b.high), low = twoSum(a.low, b.low);
  const DoubleDouble sum = fastTwoSum(high.high, high.low + low.high);
  return fastTwoSum(sum.high, sum.low + low.low);
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = twoProduct(a.high, b.high);
  return fastTwoSum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * first;
  const double second = rest.high / b.high;
  const double third = (rest - b * second).high / b.high;
  return fastTwoSum(first, second) + third;
}

inline DoubleDouble& operator+=(DoubleDouble& a, const DoubleDouble& b) { return a = a + b; }

}  // namespace mandoline::detail
