// The shortest decimal that reads back as a given double.
#pragma once

#include <cstdint>

namespace mandoline::detail {

/// digits * 10^exponent. The digits end with no 0, but for 0 itself.
struct Decimal {
  uint64_t digits;
  int exponent;
};

/// Of the decimals with fewest digits between those that read back as x, the nearest to x, which is finite and not negative.
Decimal shortestDecimal(double x);

}  // namespace mandoline::detail
