// Exact numbers of any size and range: whole numbers times powers of two. Predicates on made vertices need them, whose polynomials have
// degrees and ranges that sums of doubles (Expansion, exact.h) can't hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mandoline::detail {

/// No operation throws: if memory runs out, the result is a number without a sign, and so is everything computed from it. So polynomials
/// need no code for exceptions, which would be most of their machine code.
class Big {
 public:
  Big() noexcept = default;
  explicit Big(double v) noexcept;
  Big(const Big& other) noexcept;
  Big(Big&& other) noexcept = default;
  Big& operator=(const Big& other) noexcept;
  Big& operator=(Big&& other) noexcept = default;
  ~Big();

  static Big difference(double a, double b) noexcept;
  friend Big operator+(const Big& a, const Big& b) noexcept;
  friend Big operator-(const Big& a, const Big& b) noexcept;
  friend Big operator*(const Big& a, const Big& b) noexcept;
  Big operator-() const noexcept;

  bool certain() const noexcept { return true; }
  /// Throws bad_alloc if memory ran out on the way.
  int sign() const;
  /// The quotient as a double, within four units in the last place. Powers of two in both only shift its exponent.
  static double quotient(const Big& numerator, const Big& denominator);

 private:
  /// The leading 64 bits of the number, the first of which is 1, as a double, and the power of two that brings it to the number.
  struct Leading {
    double value;
    int64_t exponent;
  };

  static Big withoutSign() noexcept;
  static Big sum(const Big& a, const Big& b, int signOfB);
  static Big product(const Big& a, const Big& b);
  static int compareMagnitudes(const Big& a, const Big& b);
  Leading leading() const;
  uint32_t limb(int64_t place) const {  // of value 2^(32 place)
    const int64_t i = place - first_;
    return i >= 0 && i < int64_t(limbs_.size()) ? limbs_[std::size_t(i)] : 0;
  }
  int64_t end() const { return first_ + int64_t(limbs_.size()); }
  void trim();

  int sign_ = 0;
  bool failed_ = false;          // memory ran out
  int64_t first_ = 0;            // place of limbs_[0]
  std::vector<uint32_t> limbs_;  // magnitude, lowest first, no zeros at the ends
};

}  // namespace mandoline::detail
