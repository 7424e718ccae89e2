// Exact rational numbers for tests to compare with: slow, and plain enough to be trusted.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

/// A whole number: sign and magnitude, base 2^32, lowest digit first, without leading zeros.
class BigInt {
 public:
  BigInt(int64_t v = 0) : negative_(v < 0) {
    for (uint64_t m = v < 0 ? -uint64_t(v) : uint64_t(v); m != 0; m >>= 32) digits_.push_back(uint32_t(m));
  }

  int sign() const { return digits_.empty() ? 0 : negative_ ? -1 : 1; }
  BigInt operator-() const { return BigInt(digits_, !negative_); }
  friend BigInt operator+(const BigInt& a, const BigInt& b) {
    if (a.negative_ == b.negative_) return BigInt(sum(a.digits_, b.digits_), a.negative_);
    return isLess(a.digits_, b.digits_) ? BigInt(difference(b.digits_, a.digits_), b.negative_)
                                        : BigInt(difference(a.digits_, b.digits_), a.negative_);
  }
  friend BigInt operator-(const BigInt& a, const BigInt& b) { return a + -b; }
  friend BigInt operator*(const BigInt& a, const BigInt& b) {
    Digits product(a.digits_.size() + b.digits_.size(), 0);
    for (size_t i = 0; i < a.digits_.size(); ++i) {
      uint64_t carry = 0;
      for (size_t j = 0; j < b.digits_.size(); ++j) {
        carry += product[i + j] + uint64_t(a.digits_[i]) * b.digits_[j];
        product[i + j] = uint32_t(carry);
        carry >>= 32;
      }
      product[i + b.digits_.size()] = uint32_t(carry);
    }
    return BigInt(product, a.negative_ != b.negative_);
  }
  friend bool operator==(const BigInt& a, const BigInt& b) { return a.sign() == b.sign() && a.digits_ == b.digits_; }

  /// Times 2^bits.
  BigInt shiftedUp(size_t bits) const {
    Digits result(bits / 32, 0);
    uint64_t carry = 0;
    for (const uint32_t d : digits_) {
      carry |= uint64_t(d) << bits % 32;
      result.push_back(uint32_t(carry));
      carry >>= 32;
    }
    result.push_back(uint32_t(carry));
    return BigInt(result, negative_);
  }
  /// Divided by 2^bits, which must leave no rest.
  BigInt shiftedDown(size_t bits) const {
    Digits result;
    for (size_t i = bits / 32; i < digits_.size(); ++i) {
      const uint64_t above = i + 1 < digits_.size() ? digits_[i + 1] : 0;
      result.push_back(uint32_t((above << 32 | digits_[i]) >> bits % 32));
    }
    return BigInt(result, negative_);
  }
  /// How often 2 divides it; it must not be 0.
  size_t trailingZeros() const {
    size_t i = 0, bit = 0;
    while (digits_[i] == 0) ++i;
    while ((digits_[i] >> bit & 1) == 0) ++bit;
    return 32 * i + bit;
  }

 private:
  using Digits = std::vector<uint32_t>;

  BigInt(Digits digits, bool negative) : digits_(std::move(digits)), negative_(negative) {
    while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
  }
  static bool isLess(const Digits& a, const Digits& b) {
    return a.size() != b.size() ? a.size() < b.size() : std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  }
  static Digits sum(const Digits& a, const Digits& b) {
    Digits result;
    uint64_t carry = 0;
    for (size_t i = 0; i < std::max(a.size(), b.size()) || carry != 0; ++i) {
      carry += uint64_t(i < a.size() ? a[i] : 0) + (i < b.size() ? b[i] : 0);
      result.push_back(uint32_t(carry));
      carry >>= 32;
    }
    return result;
  }
  static Digits difference(const Digits& a, const Digits& b) {  // a >= b
    Digits result;
    int64_t borrow = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      const int64_t d = int64_t(a[i]) - (i < b.size() ? b[i] : 0) + borrow;
      result.push_back(uint32_t(d));
      borrow = d < 0 ? -1 : 0;
    }
    return result;
  }

  Digits digits_;
  bool negative_ = false;
};

/// A quotient of whole numbers; only common factors of two are taken out.
class Rational {
 public:
  Rational(double v = 0) {
    int exponent = 0;
    numerator_ = int64_t(std::ldexp(std::frexp(v, &exponent), 53));
    BigInt& part = exponent > 53 ? numerator_ : denominator_;
    part = part.shiftedUp(size_t(std::abs(exponent - 53)));
    reduce();
  }

  int sign() const { return numerator_.sign(); }
  Rational operator-() const { return Rational(-numerator_, denominator_); }
  friend Rational operator+(const Rational& a, const Rational& b) {
    if (a.denominator_ == b.denominator_) return Rational(a.numerator_ + b.numerator_, a.denominator_);
    return Rational(a.numerator_ * b.denominator_ + b.numerator_ * a.denominator_, a.denominator_ * b.denominator_);
  }
  friend Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
  friend Rational operator*(const Rational& a, const Rational& b) {
    return Rational(a.numerator_ * b.numerator_, a.denominator_ * b.denominator_);
  }
  friend Rational operator/(const Rational& a, const Rational& b) {
    const Rational q(a.numerator_ * b.denominator_, a.denominator_ * b.numerator_);
    return b.sign() > 0 ? q : Rational(-q.numerator_, -q.denominator_);
  }
  /// Sign of a - b.
  friend int order(const Rational& a, const Rational& b) {
    if (a.denominator_ == b.denominator_) return (a.numerator_ - b.numerator_).sign();
    return (a.numerator_ * b.denominator_ - b.numerator_ * a.denominator_).sign();
  }
  friend bool operator==(const Rational& a, const Rational& b) { return order(a, b) == 0; }
  friend bool operator!=(const Rational& a, const Rational& b) { return order(a, b) != 0; }
  friend bool operator<(const Rational& a, const Rational& b) { return order(a, b) < 0; }
  friend bool operator>(const Rational& a, const Rational& b) { return order(a, b) > 0; }
  friend bool operator<=(const Rational& a, const Rational& b) { return order(a, b) <= 0; }
  friend bool operator>=(const Rational& a, const Rational& b) { return order(a, b) >= 0; }

 private:
  Rational(BigInt numerator, BigInt denominator) : numerator_(std::move(numerator)), denominator_(std::move(denominator)) { reduce(); }
  void reduce() {
    if (numerator_.sign() == 0) {
      denominator_ = 1;
      return;
    }
    const size_t twos = std::min(numerator_.trailingZeros(), denominator_.trailingZeros());
    if (twos == 0) return;
    numerator_ = numerator_.shiftedDown(twos);
    denominator_ = denominator_.shiftedDown(twos);
  }

  BigInt numerator_, denominator_ = 1;  // the denominator is positive
};

inline Rational abs(const Rational& r) { return r.sign() < 0 ? -r : r; }
