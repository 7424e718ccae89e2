// Geometry of validate(): exact signs where the input's doubles decide, and distances that stay accurate for thin triangles.
#include <algorithm>

#include "operators/validate_parts.h"

namespace mandoline::validation {
namespace {

/// A double and what rounding took from it.
struct Pair {
  double high, low;
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
  return {p, x.low * y.low - (((p - x.high * y.high) - x.low * y.high) - x.high * y.low)};
}

/// A sum of doubles kept exactly, as parts of ascending size that do not overlap (Shewchuk 1997).
class Expansion {
 public:
  void add(double x) {
    for (int i = 0; i < size_; ++i) {
      const Pair s = exactSum(x, part_[i]);
      x = s.high;
      part_[i] = s.low;
    }
    part_[size_++] = x;
  }
  void addProduct(const Pair& a, const Pair& b, double sign) {
    for (const double x : {a.low, a.high}) {
      for (const double y : {b.low, b.high}) {
        const Pair p = exactProduct(x, y);
        add(sign * p.low);
        add(sign * p.high);
      }
    }
  }
  int sign() const {
    for (int i = size_ - 1; i >= 0; --i) {
      if (part_[i] != 0) return part_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  double part_[16];
  int size_ = 0;
};

}  // namespace

int differenceSign(double a, double b, double c, double d, double e, double f, double g, double h) {
  const double left = (a - b) * (c - d), right = (e - f) * (g - h), difference = left - right;
  // Three roundings in each product and one in their difference.
  if (std::fabs(difference) > 8 * kRounding * (std::fabs(left) + std::fabs(right))) return difference > 0 ? 1 : -1;
  Expansion sum;
  sum.addProduct(exactSum(a, -b), exactSum(c, -d), 1);
  sum.addProduct(exactSum(e, -f), exactSum(g, -h), -1);
  return sum.sign();
}

int turn(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int e = (axis + 1) % 3, f = (axis + 2) % 3;
  return differenceSign(b[e], a[e], c[f], a[f], b[f], a[f], c[e], a[e]);
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

Check Tally::finish() {
  check_.pass = check_.skipped || check_.worst <= check_.tolerance;
  if (check_.elementKind.empty()) {
    if (!check_.skipped) check_.message = note_;
    return check_;
  }
  if (!check_.pass) {
    check_.message = check_.elementKind + " " + std::to_string(check_.element) + " " + text_;
    if (check_.tolerance > 0) {
      check_.message += ": " + std::to_string(check_.worst) + " roundings, " + std::to_string(int(check_.tolerance)) + " are allowed";
    } else if (check_.worst > 1) {
      check_.message += "; " + std::to_string(int64_t(check_.worst)) + " violations in all";
    }
  } else {
    check_.message = note_;
  }
  return check_;
}

}  // namespace mandoline::validation
