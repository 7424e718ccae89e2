// Exact incidences at little cost: whether a polynomial of doubles is 0, for any degree and any range of doubles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/plain_arithmetic.h"

namespace mandoline::validation {

namespace modulus {

constexpr uint64_t kPrime = 2282848535969421923;

constexpr uint64_t below(uint64_t x) { return x >= kPrime ? x - kPrime : x; }

constexpr uint64_t powerOfTwo(int exponent) {
  uint64_t power = 1;
  for (int i = 0; i < exponent; ++i) power = below(2 * power);
  return power;
}

/// The inverse of the prime modulo 2^64: each step doubles the number of its bits that are right.
constexpr uint64_t inverseOfPrime() {
  uint64_t inverse = 1;
  for (int i = 0; i < 6; ++i) inverse *= 2 - kPrime * inverse;
  return inverse;
}

}  // namespace modulus

/// An integer modulo a prime. Each double has a residue (2 has an inverse), sums, differences and products of residues are those of the
/// exact numbers, and so are quotients unless the divisor's residue is 0. What is 0 has the residue 0; anything else has it by an accident
/// that is to be expected once in 10^18 comparisons: the prime was drawn at random, so that it is unrelated to differences of powers of
/// two, which doubles often have. There are no signs.
class Residue {
 public:
  Residue() = default;
  Residue(double x) {
    int exponent = 0;
    uint64_t value = uint64_t(std::fabs(std::frexp(x, &exponent)) * 0x1p53);
    // Times 2^(exponent - 53), and times 2^64 because all are kept so; and the last product takes away as much.
    int shift = exponent - 53 + 128;
    for (; shift < 0; shift += 64) value = product(value, 1);
    for (; shift >= 64; shift -= 64) value = product(value, kTwoTo128);
    value_ = product(value, uint64_t(1) << shift);
    if (x < 0) *this = Residue() - *this;
  }

  bool isZero() const { return value_ == 0; }
  bool operator==(const Residue& other) const { return value_ == other.value_; }
  uint64_t bits() const { return value_; }

  Residue operator+(const Residue& other) const { return of(below(value_ + other.value_)); }
  Residue operator-(const Residue& other) const { return of(below(value_ + (kPrime - other.value_))); }
  Residue operator*(const Residue& other) const { return of(product(value_, other.value_)); }
  /// 1 / this, by Fermat's little theorem; 0 if this is 0.
  Residue inverse() const {
    Residue result(1), power = *this;
    for (uint64_t exponent = kPrime - 2; exponent > 0; exponent >>= 1) {
      if (exponent & 1) result = result * power;
      power = power * power;
    }
    return result;
  }

 private:
  static constexpr uint64_t kPrime = modulus::kPrime, kTwoTo128 = modulus::powerOfTwo(128), kInverse = modulus::inverseOfPrime();
  static constexpr uint64_t below(uint64_t x) { return modulus::below(x); }

  /// The upper 64 bits of a b.
  static uint64_t upper(uint64_t a, uint64_t b) {
#ifdef __SIZEOF_INT128__
    return uint64_t(static_cast<unsigned __int128>(a) * b >> 64);
#else
    const uint64_t low = UINT32_MAX, one = (a >> 32) * (b & low) + ((a & low) * (b & low) >> 32),
                   other = (a & low) * (b >> 32) + (one & low);
    return (a >> 32) * (b >> 32) + (one >> 32) + (other >> 32);
#endif
  }
  /// a b / 2^64 modulo the prime (Montgomery), for a below the prime.
  static uint64_t product(uint64_t a, uint64_t b) {
    const uint64_t multiple = upper(a * b * kInverse, kPrime), high = upper(a, b);
    return high >= multiple ? high - multiple : high + kPrime - multiple;
  }
  static Residue of(uint64_t value) {
    Residue result;
    result.value_ = value;
    return result;
  }

  uint64_t value_ = 0;  // times 2^64
};

}  // namespace mandoline::validation
