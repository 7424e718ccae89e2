// The shortest decimal that reads back as a given double.
#pragma once

#include <cstdint>

namespace mandoline::detail {

/// digits * 10^exponent. The last digit is not 0, except for 0 itself.
struct Decimal {
  uint64_t digits;
  int exponent;
};

/// Among the decimals that read back as x and have the fewest digits, the one nearest to x, which is finite and not negative.
Decimal shortestDecimal(double x);

}  // namespace mandoline::detail
