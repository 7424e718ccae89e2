#include "base/exact.h"

namespace mandoline::detail {

Expansion Expansion::sum(const Expansion& a, const Expansion& b, double signOfB) {
  Expansion result;
  const size_t na = a.terms_.size(), nb = b.terms_.size();
  result.terms_.reserve(na + nb);
  double q = 0;
  for (size_t i = 0, j = 0; i < na || j < nb;) {
    const bool fromA = j == nb || (i < na && std::fabs(a.terms_[i]) < std::fabs(b.terms_[j]));
    const TwoTerms s = twoSum(q, fromA ? a.terms_[i++] : signOfB * b.terms_[j++]);
    result.push(s.low);
    q = s.high;
  }
  result.push(q);
  return result;
}

Expansion Expansion::scale(const Expansion& a, double b) {
  Expansion result;
  result.terms_.reserve(2 * a.terms_.size());
  double q = 0;
  for (const double t : a.terms_) {
    const TwoTerms p = twoProduct(t, b);
    const TwoTerms low = twoSum(q, p.low);
    result.push(low.low);
    const TwoTerms high = twoSum(p.high, low.high);
    result.push(high.low);
    q = high.high;
  }
  result.push(q);
  return result;
}

Expansion operator*(const Expansion& a, const Expansion& b) {
  const Expansion& longer = a.terms_.size() >= b.terms_.size() ? a : b;
  const Expansion& shorter = &longer == &a ? b : a;
  Expansion result;
  for (const double t : shorter.terms_) result = result + Expansion::scale(longer, t);
  return result;
}

double Expansion::estimate() const {
  double total = 0;
  for (const double t : terms_) total += t;
  return total;
}

double Expansion::quotient(const Expansion& numerator, const Expansion& denominator) {
  const double first = numerator.estimate() / denominator.estimate();
  const Expansion rest = numerator - scale(denominator, first);  // one Newton step removes the error of both estimates
  return first + rest.estimate() / denominator.estimate();
}

int Predicates::orient2d(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), det = left - right;
  if (std::fabs(det) > kTurnError * (std::fabs(left) + std::fabs(right))) return signOf(det);
  if (left == 0 && right == 0) return 0;  // no underflow: a factor is exactly 0 in each
  ++fallbacks;
  const TwoTerms ax = twoDiff(a.x, c.x), ay = twoDiff(a.y, c.y), bx = twoDiff(b.x, c.x), by = twoDiff(b.y, c.y);
  if (ax.low == 0 && ay.low == 0 && bx.low == 0 && by.low == 0) {  // as often on lattices
    const TwoTerms l = twoProduct(ax.high, by.high), r = twoProduct(ay.high, bx.high);
    return l.high != r.high ? signOf(l.high - r.high) : signOf(l.low - r.low);
  }
  const auto d = &Expansion::difference;
  return (d(a.x, c.x) * d(b.y, c.y) - d(a.y, c.y) * d(b.x, c.x)).sign();
}

int Predicates::orient3d(const double* a, const double* b, const double* c, const double* d) {
  // Shewchuk's static filter: (7 + 56 u) u times the permanent.
  constexpr double bound = (7 + 56 * kRoundoff) * kRoundoff;
  const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  const double dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
  const double m1 = cy * dz, m2 = cz * dy, m3 = by * dz, m4 = bz * dy, m5 = by * cz, m6 = bz * cy;
  const double det = bx * (m1 - m2) - cx * (m3 - m4) + dx * (m5 - m6);
  const double permanent = std::fabs(bx) * (std::fabs(m1) + std::fabs(m2)) + std::fabs(cx) * (std::fabs(m3) + std::fabs(m4)) +
                           std::fabs(dx) * (std::fabs(m5) + std::fabs(m6));
  if (std::fabs(det) > bound * permanent) return signOf(det);
  if (permanent == 0) return 0;
  if ((bx == 0 && cx == 0 && dx == 0) || (by == 0 && cy == 0 && dy == 0) || (bz == 0 && cz == 0 && dz == 0)) return 0;  // an axial plane
  ++fallbacks;
  const auto diff = &Expansion::difference;
  const Expansion Bx = diff(b[0], a[0]), By = diff(b[1], a[1]), Bz = diff(b[2], a[2]);
  const Expansion Cx = diff(c[0], a[0]), Cy = diff(c[1], a[1]), Cz = diff(c[2], a[2]);
  const Expansion Dx = diff(d[0], a[0]), Dy = diff(d[1], a[1]), Dz = diff(d[2], a[2]);
  return (Bx * (Cy * Dz - Cz * Dy) - Cx * (By * Dz - Bz * Dy) + Dx * (By * Cz - Bz * Cy)).sign();
}

}  // namespace mandoline::detail
