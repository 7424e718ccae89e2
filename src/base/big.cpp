#include "base/big.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>

#include "base/plain_arithmetic.h"

namespace mandoline::detail {

Big Big::withoutSign() noexcept {
  Big big;
  big.failed_ = true;
  return big;
}

Big::Big(double v) noexcept {
  if (v == 0) return;
  sign_ = v > 0 ? 1 : -1;
  int exponent;
  const uint64_t mantissa = uint64_t(std::ldexp(std::frexp(std::fabs(v), &exponent), 53));
  exponent -= 53;
  first_ = exponent >> 5;  // rounded down
  const int shift = exponent & 31;
  const uint64_t low = mantissa << shift, high = shift == 0 ? 0 : mantissa >> (64 - shift);
  try {
    limbs_ = {uint32_t(low), uint32_t(low >> 32), uint32_t(high)};
    trim();
  } catch (const std::bad_alloc&) {
    failed_ = true;
  }
}

Big::Big(const Big& other) noexcept : sign_(other.sign_), failed_(other.failed_), first_(other.first_) {
  try {
    limbs_ = other.limbs_;
  } catch (const std::bad_alloc&) {
    failed_ = true;
  }
}

Big& Big::operator=(const Big& other) noexcept {
  if (this != &other) *this = Big(other);
  return *this;
}

Big::~Big() = default;

Big Big::difference(double a, double b) noexcept { return Big(a) - Big(b); }

Big operator+(const Big& a, const Big& b) noexcept {
  try {
    return Big::sum(a, b, b.sign_);
  } catch (const std::bad_alloc&) {
    return Big::withoutSign();
  }
}

Big operator-(const Big& a, const Big& b) noexcept {
  try {
    return Big::sum(a, b, -b.sign_);
  } catch (const std::bad_alloc&) {
    return Big::withoutSign();
  }
}

Big operator*(const Big& a, const Big& b) noexcept {
  try {
    return Big::product(a, b);
  } catch (const std::bad_alloc&) {
    return Big::withoutSign();
  }
}

Big Big::operator-() const noexcept {
  Big n = *this;
  n.sign_ = -n.sign_;
  return n;
}

int Big::sign() const {
  if (failed_) throw std::bad_alloc();
  return sign_;
}

void Big::trim() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  size_t zeros = 0;
  while (zeros < limbs_.size() && limbs_[zeros] == 0) ++zeros;
  if (zeros > 0) {
    limbs_.erase(limbs_.begin(), limbs_.begin() + std::ptrdiff_t(zeros));
    first_ += int64_t(zeros);
  }
  if (limbs_.empty()) {
    sign_ = 0;
    first_ = 0;
  }
}

int Big::compareMagnitudes(const Big& a, const Big& b) {
  if (a.end() != b.end()) return a.end() < b.end() ? -1 : 1;
  for (int64_t place = a.end() - 1; place >= std::min(a.first_, b.first_); --place) {
    if (a.limb(place) != b.limb(place)) return a.limb(place) < b.limb(place) ? -1 : 1;
  }
  return 0;
}

Big Big::sum(const Big& a, const Big& b, int signOfB) {
  if (a.failed_ || b.failed_) return withoutSign();
  if (signOfB == 0) return a;
  Big result;
  if (a.sign_ == 0) {
    result = b;
    result.sign_ = signOfB;
    return result;
  }
  const int64_t first = std::min(a.first_, b.first_), end = std::max(a.end(), b.end());
  result.first_ = first;
  result.limbs_.reserve(size_t(end - first) + 1);
  if (a.sign_ == signOfB) {
    result.sign_ = a.sign_;
    uint64_t carry = 0;
    for (int64_t place = first; place < end; ++place) {
      carry += uint64_t(a.limb(place)) + b.limb(place);
      result.limbs_.push_back(uint32_t(carry));
      carry >>= 32;
    }
    result.limbs_.push_back(uint32_t(carry));
  } else {
    const int order = compareMagnitudes(a, b);
    if (order == 0) return Big();
    const Big &larger = order > 0 ? a : b, &smaller = order > 0 ? b : a;
    result.sign_ = order > 0 ? a.sign_ : signOfB;
    int64_t borrow = 0;
    for (int64_t place = first; place < end; ++place) {
      borrow += int64_t(larger.limb(place)) - int64_t(smaller.limb(place));
      result.limbs_.push_back(uint32_t(borrow));
      borrow >>= 32;
    }
  }
  result.trim();
  return result;
}

Big Big::product(const Big& a, const Big& b) {
  if (a.failed_ || b.failed_) return withoutSign();
  Big result;
  if (a.sign_ == 0 || b.sign_ == 0) return result;
  result.sign_ = a.sign_ * b.sign_;
  result.first_ = a.first_ + b.first_;
  result.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (size_t i = 0; i < a.limbs_.size(); ++i) {
    uint64_t carry = 0;
    for (size_t j = 0; j < b.limbs_.size(); ++j) {
      carry += uint64_t(a.limbs_[i]) * b.limbs_[j] + result.limbs_[i + j];
      result.limbs_[i + j] = uint32_t(carry);
      carry >>= 32;
    }
    result.limbs_[i + b.limbs_.size()] = uint32_t(carry);
  }
  result.trim();
  return result;
}

Big::Leading Big::leading() const {
  const int64_t top = end() - 1;
  const int zeros = std::countl_zero(limb(top));
  const uint64_t high = uint64_t(limb(top)) << 32 | limb(top - 1), low = limb(top - 2);
  return {double(high << zeros | (low << zeros) >> 32), 32 * (top - 1) - zeros};
}

double Big::quotient(const Big& numerator, const Big& denominator) {
  if (numerator.sign() == 0 || denominator.sign() == 0) return 0;
  const Leading n = numerator.leading(), d = denominator.leading();
  const int64_t exponent = std::clamp<int64_t>(n.exponent - d.exponent, -4000, 4000);
  return numerator.sign_ * denominator.sign_ * std::ldexp(n.value / d.value, int(exponent));
}

}  // namespace mandoline::detail
