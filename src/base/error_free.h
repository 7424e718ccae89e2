// Sums, differences and products of doubles without error, as two terms (Dekker 1971, Shewchuk 1997). All exact numbers are made of them.
// Needs plain IEEE arithmetic: compile with -ffp-contract=off.
#pragma once

#include "base/plain_arithmetic.h"

namespace mandoline::detail {

struct TwoTerms {
  double high, low;  // high + low is exact, high = round(high + low)
};

inline TwoTerms twoSum(double a, double b) {
  const double high = a + b, bv = high - a, av = high - bv;
  return {high, (a - av) + (b - bv)};
}

/// The same where |a| >= |b| or a is 0.
inline TwoTerms fastTwoSum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

inline TwoTerms twoDiff(double a, double b) {
  const double high = a - b, bv = a - high, av = high + bv;
  return {high, (a - av) + (bv - b)};
}

/// Exact unless it over- or underflows.
inline TwoTerms twoProduct(double a, double b) {
  constexpr double splitter = 0x1p27 + 1;
  const double ca = splitter * a, ah = ca - (ca - a), al = a - ah;
  const double cb = splitter * b, bh = cb - (cb - b), bl = b - bh;
  const double high = a * b;
  return {high, al * bl - (((high - ah * bh) - al * bh) - ah * bl)};
}

}  // namespace mandoline::detail
