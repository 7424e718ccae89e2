// Geometry of validate(): exact signs where the input's doubles decide, and distances that stay accurate for thin triangles.
#include "operators/validate/geometry.h"

#include <algorithm>

namespace mandoline::validation {
Exact::Exact(double x) {
  if (x == 0) return;
  int exponent = 0;
  std::frexp(x, &exponent);
  exponent -= 53;  // of the last bit
  exponent_ = (exponent - (exponent < 0 ? kBits - 1 : 0)) / kBits;
  x = std::ldexp(x, -kBits * exponent_);
  while (x != 0) {
    const double rest = std::trunc(std::ldexp(x, -kBits));
    digits_.push_back(int64_t(x - std::ldexp(rest, kBits)));
    x = rest;
  }
  carry();
}

Exact Exact::sum(const Exact& other, int64_t sign) const {
  if (other.digits_.empty()) return *this;
  Exact result;
  result.exponent_ = digits_.empty() ? other.exponent_ : std::min(exponent_, other.exponent_);
  const auto add = [&](const Exact& x, int64_t factor) {
    const size_t first = size_t(x.exponent_ - result.exponent_);
    if (!x.digits_.empty()) result.digits_.resize(std::max(result.digits_.size(), first + x.digits_.size()));
    for (size_t i = 0; i < x.digits_.size(); ++i) result.digits_[first + i] += factor * x.digits_[i];
  };
  add(*this, 1);
  add(other, sign);
  result.carry();
  return result;
}

Exact Exact::operator*(const Exact& other) const {
  Exact result;
  if (digits_.empty() || other.digits_.empty()) return result;
  result.exponent_ = exponent_ + other.exponent_;
  result.digits_.resize(digits_.size() + other.digits_.size());
  for (size_t i = 0; i < digits_.size(); ++i) {
    for (size_t k = 0; k < other.digits_.size(); ++k) result.digits_[i + k] += digits_[i] * other.digits_[k];
  }
  result.carry();
  return result;
}

void Exact::carry() {
  constexpr int64_t kHalf = int64_t(1) << (kBits - 1);
  int64_t over = 0;
  for (size_t i = 0; i < digits_.size() || over != 0; ++i) {
    if (i == digits_.size()) digits_.push_back(0);
    const int64_t digit = digits_[i] + over;
    over = (digit + kHalf) >> kBits;
    digits_[i] = digit - over * (2 * kHalf);
  }
  while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
}

int differenceSign(const Product& x, const Product& y) {
  const double left = (x.a - x.b) * (x.c - x.d), right = (y.a - y.b) * (y.c - y.d), difference = left - right;
  // Three roundings in each product and one in their difference.
  if (std::fabs(difference) > 8 * kRounding * (std::fabs(left) + std::fabs(right))) return difference > 0 ? 1 : -1;
  return ((Exact(x.a) - x.b) * (Exact(x.c) - x.d) - (Exact(y.a) - y.b) * (Exact(y.c) - y.d)).sign();
}

int turn(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int e = (axis + 1) % 3, f = (axis + 2) % 3;
  return differenceSign({b[e], a[e], c[f], a[f]}, {b[f], a[f], c[e], a[e]});
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return turn(a, b, c, 0) == 0 && turn(a, b, c, 1) == 0 && turn(a, b, c, 2) == 0;
}

double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a, rest = p - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(rest, along) / square, 0.0, 1.0) : 0;
  return length(rest - t * along);
}

double distanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double toBoundary = std::min({distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
  const Vec3 ab = b - a, ac = c - a, ap = p - a, n = cross(ab, ac);
  const double square = dot(n, n);
  if (!(square > 0)) return toBoundary;
  // The foot of the perpendicular, v ab + w ac. One step is as accurate as the triangle is fat; each further one solves for the rest.
  double v = 0, w = 0, distance = length(ap);
  Vec3 rest = ap;
  for (int step = 0; step < 8; ++step) {
    v += dot(cross(rest, ac), n) / square;
    w += dot(cross(ab, rest), n) / square;
    rest = ap - (v * ab + w * ac);
    const double before = distance;
    distance = length(rest);
    if (!(distance < before / 2)) break;
  }
  return v >= 0 && w >= 0 && v + w <= 1 ? std::min(distance, toBoundary) : toBoundary;
}

Normal normalOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  Normal result{cross(ab, ac), {}};
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    result.error[d] = 5 * kRounding * (std::fabs(ab[e] * ac[f]) + std::fabs(ab[f] * ac[e]));
  }
  return result;
}

}  // namespace mandoline::validation
