// Double-double arithmetic: a number as the unevaluated sum of two doubles, some 106 bits (Dekker 1971). The operators work on results and
// share no code with the cutter, so this stands apart from its exact numbers. Needs plain IEEE arithmetic: compile with -ffp-contract=off.
#pragma once

namespace mandoline::operators {

struct DoubleDouble {
  double high = 0, low = 0;  // low is at most half a unit in the last place of high

  DoubleDouble() = default;
  DoubleDouble(double value) : high(value) {}
  DoubleDouble(double high_, double low_) : high(high_), low(low_) {}
  explicit operator double() const { return high; }
};

/// a + b, exactly.
inline DoubleDouble twoSum(double a, double b) {
  const double high = a + b, bPart = high - a, aPart = high - bPart;
  return {high, (a - aPart) + (b - bPart)};
}

/// a + b, exactly, where |a| >= |b| or a is 0.
inline DoubleDouble fastTwoSum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

/// a * b, exactly, unless it over- or underflows.
inline DoubleDouble twoProduct(double a, double b) {
  constexpr double kSplitter = 0x1p27 + 1;
  const double aScaled = kSplitter * a, aHigh = aScaled - (aScaled - a), aLow = a - aHigh;
  const double bScaled = kSplitter * b, bHigh = bScaled - (bScaled - b), bLow = b - bHigh;
  const double high = a * b;
  return {high, aLow * bLow - (((high - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow)};
}

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }

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

}  // namespace mandoline::operators
