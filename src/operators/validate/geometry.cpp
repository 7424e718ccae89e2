// Geometry of validate(): exact signs where the input's doubles decide, and distances that stay accurate for thin triangles.
#include "operators/validate/geometry.h"

#include <algorithm>

namespace mandoline::validation {
namespace {

struct Pair {
  double value, lost;  // what rounding took from it
};

Pair exactSum(double a, double b) {
  const double s = a + b, bPart = s - a, aPart = s - bPart;
  return {s, (a - aPart) + (b - bPart)};
}

Pair exactProduct(double a, double b) {
  const auto split = [](double x) {
    const double c = 134217729.0 * x, high = c - (c - x);
    return Pair{high, x - high};
  };
  const double p = a * b;
  const Pair x = split(a), y = split(b);
  return {p, x.lost * y.lost - (((p - x.value * y.value) - x.lost * y.value) - x.value * y.lost)};
}

}  // namespace

void Exact::add(double x) {
  size_t kept = 0;
  for (const double part : parts_) {
    const Pair s = exactSum(x, part);
    x = s.value;
    if (s.lost != 0) parts_[kept++] = s.lost;
  }
  parts_.resize(kept);
  if (x != 0) parts_.push_back(x);
}

Exact Exact::operator+(const Exact& other) const {
  Exact result = *this;
  for (const double part : other.parts_) result.add(part);
  return result;
}

Exact Exact::operator-(const Exact& other) const {
  Exact result = *this;
  for (const double part : other.parts_) result.add(-part);
  return result;
}

Exact Exact::operator*(const Exact& other) const {
  Exact result;
  for (const double a : parts_) {
    for (const double b : other.parts_) {
      const Pair p = exactProduct(a, b);
      result.add(p.lost);
      result.add(p.value);
    }
  }
  return result;
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

bool coplanar(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Normal normal = normalOf(a, b, c);
  const Vec3 ad = d - a;
  double doubt = 0;
  for (int i = 0; i < 3; ++i) doubt += std::fabs(ad[i]) * (2 * normal.error[i] + 4 * kRounding * std::fabs(normal.n[i]));
  if (std::fabs(dot(ad, normal.n)) > doubt) return false;
  Exact volume;
  for (int i = 0; i < 3; ++i) {
    const int e = (i + 1) % 3, f = (i + 2) % 3;
    volume = volume + (Exact(d[i]) - a[i]) * ((Exact(b[e]) - a[e]) * (Exact(c[f]) - a[f]) - (Exact(b[f]) - a[f]) * (Exact(c[e]) - a[e]));
  }
  return volume.sign() == 0;
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
