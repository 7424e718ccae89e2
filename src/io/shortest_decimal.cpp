// After R. Giulietti, The Schubfach way to render doubles (2021), whose c, q, k and h these are: a double is c 2^q. What lies between the
// halfway points to its neighbours reads back as it. Multiples of 10^k are as far apart as they can be with one of them there for sure.
#include "io/shortest_decimal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace mandoline::detail {
namespace {

/// high 2^64 + low.
struct Wide {
  uint64_t high, low;
};

Wide product(uint64_t a, uint64_t b) {
  const uint64_t a0 = uint32_t(a), a1 = a >> 32, b0 = uint32_t(b), b1 = b >> 32;
  const uint64_t low = a0 * b0, across = a1 * b0;
  const uint64_t middle = (low >> 32) + uint32_t(across) + a0 * b1;
  return {a1 * b1 + (across >> 32) + (middle >> 32), middle << 32 | uint32_t(low)};
}

/// Floors of logarithms, for exponents of doubles.
constexpr int log2OfPowerOf10(int n) { return (n * 1741647) >> 19; }
constexpr int log10OfPowerOf2(int n) { return (n * 1262611) >> 22; }
constexpr int log10OfThreeQuartersOfPowerOf2(int n) { return (n * 1262611 - 524031) >> 22; }

/// The leading 128 bits of 10^n, rounded up, for all n that are needed.
class PowersOf10 {
 public:
  PowersOf10() {
    // Those of 5^n are the same. The floor of a quotient by 5^n is what dividing n times by 5 and leaving out remainders gives.
    Words words = {1};
    for (int n = 0; n <= kMost; ++n) {
      powers_[size_t(n - kLeast)] = leading(words, false);
      multiplyBy5(words);
    }
    words = {};
    words.back() = 1;
    for (int n = -1; n >= kLeast; --n) {
      divideBy5(words);
      powers_[size_t(n - kLeast)] = leading(words, true);
    }
  }

  const Wide& operator[](int n) const { return powers_[size_t(n - kLeast)]; }

 private:
  static constexpr int kLeast = -292, kMost = 324;
  using Words = std::array<uint32_t, 27>;  // the lowest first: room for 5^325, and for more than 128 bits of 2^832 / 5^292

  static void multiplyBy5(Words& words) {
    uint64_t carry = 0;
    for (uint32_t& word : words) {
      carry += uint64_t(word) * 5;
      word = uint32_t(carry);
      carry >>= 32;
    }
  }

  static void divideBy5(Words& words) {
    uint64_t rest = 0;
    for (size_t i = words.size(); i-- > 0;) {
      rest = rest << 32 | words[i];
      words[i] = uint32_t(rest / 5);
      rest %= 5;
    }
  }

  /// Rounded up if there is more, in the words or besides.
  static Wide leading(const Words& words, bool more) {
    size_t top = words.size() - 1;
    while (words[top] == 0) --top;
    const auto word = [&](size_t below) { return uint64_t(below <= top ? words[top - below] : 0); };
    const int shift = std::countl_zero(words[top]);
    const uint64_t next = word(4) << shift;
    Wide bits = {(word(0) << 32 | word(1)) << shift | word(2) << shift >> 32, (word(2) << 32 | word(3)) << shift | next >> 32};
    more = more || uint32_t(next) != 0;
    for (size_t i = 5; i <= top; ++i) more = more || word(i) != 0;
    if (more && ++bits.low == 0) ++bits.high;
    return bits;
  }

  std::array<Wide, kMost - kLeast + 1> powers_;
};

/// power c / 2^128, with the lowest bit set if that is not a whole number.
uint64_t scaled(const Wide& power, uint64_t c) {
  Wide sum = product(power.high, c);
  const uint64_t carry = product(power.low, c).high;
  sum.low += carry;
  if (sum.low < carry) ++sum.high;
  return sum.high | (sum.low > 1);
}

Decimal withoutZeros(uint64_t digits, int exponent) {
  constexpr uint64_t kMany = 100'000'000;
  if (digits % kMany == 0) digits /= kMany, exponent += 8;
  while (digits % 10 == 0) digits /= 10, ++exponent;
  return {digits, exponent};
}

}  // namespace

Decimal shortestDecimal(double x) {
  if (x == 0) return {0, 0};
  constexpr uint64_t kHidden = uint64_t(1) << 52;
  uint64_t bits;
  std::memcpy(&bits, &x, sizeof x);
  const uint64_t fraction = bits % kHidden;
  const int biased = int(bits / kHidden), q = std::max(biased, 1) - 1075;
  const uint64_t c = biased == 0 ? fraction : kHidden + fraction;
  if (-53 < q && q <= 0 && std::countr_zero(c) >= -q) return withoutZeros(c >> -q, 0);

  static const PowersOf10 powers;
  const bool closeBelow = fraction == 0 && biased > 1;  // the next double below is half as far as the next above
  const int k = closeBelow ? log10OfThreeQuartersOfPowerOf2(q) : log10OfPowerOf2(q);
  const int h = q + log2OfPowerOf10(-k) + 1;
  // In quarters of 10^k: the double and, with their own borders where c is even, the places that read back as it.
  const uint64_t value = scaled(powers[-k], (4 * c) << h), odd = c % 2;
  const uint64_t least = scaled(powers[-k], (4 * c - 2 + closeBelow) << h) + odd;
  const uint64_t most = scaled(powers[-k], (4 * c + 2) << h) - odd;
  const auto isInside = [&](uint64_t multiple) { return least <= 4 * multiple && 4 * multiple <= most; };

  const uint64_t below = value / 4, belowByTens = below / 10 * 10;
  if (below >= 10 && isInside(belowByTens) != isInside(belowByTens + 10))
    return withoutZeros(belowByTens / 10 + !isInside(belowByTens), k + 1);
  if (isInside(below) != isInside(below + 1)) return withoutZeros(below + !isInside(below), k);
  const uint64_t halfway = 4 * below + 2;
  const bool up = value > halfway || (value == halfway && below % 2 == 1);
  return withoutZeros(below + up, k);
}

}  // namespace mandoline::detail
