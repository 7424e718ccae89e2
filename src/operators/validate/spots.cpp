#include "operators/validate/spots.h"

#include "operators/validate/place_finder.h"

namespace mandoline::validation {
namespace {

/// dot(normal, p) - offset at a point, times its w.
Exact heightOf(const ExactPoint& p, const PlaneOf<Exact>& plane) { return dot(plane.normal, p.x) - plane.offset * p.w; }

ExactPoint exactVertex(const Context& context, uint32_t v) {
  const auto q = Finder<Exact>(context).placeOf(v);
  const Exact sign = q.w.sign();
  return {sign * q.x, sign * q.w};
}

ExactPoint madeExactly(const Context& context, const Spot& spot);

const ExactPoint& exactPoint(const Context& context, const Spot& spot) {
  if (!spot.exact) spot.exact = madeExactly(context, spot);
  return *spot.exact;
}

ExactPoint madeExactly(const Context& context, const Spot& spot) {
  if (!spot.ends[0]) return exactVertex(context, spot.vertex);
  const ExactPoint &a = exactPoint(context, *spot.ends[0]), &b = exactPoint(context, *spot.ends[1]);
  if (spot.triangle < 0) return {b.w * a.x + a.w * b.x, Exact(2) * a.w * b.w};
  const PlaneOf<Exact> plane = Finder<Exact>(context).planeOf(size_t(spot.triangle));
  const Exact above = heightOf(a, plane), below = heightOf(b, plane), sign = above.sign();
  return {(sign * above) * b.x - (sign * below) * a.x, (sign * above) * b.w - (sign * below) * a.w};
}

/// Twice the area that three points span, seen along an axis, times their w.
template <class Point>
auto areaOf(const Point& a, const Point& b, const Point& c, int axis) {
  const size_t d = size_t(axis + 1) % 3, e = size_t(axis + 2) % 3;
  const auto minor = [&](const Point& p, const Point& q) { return p.x[d] * q.x[e] - p.x[e] * q.x[d]; };
  return a.w * minor(b, c) + b.w * minor(c, a) + c.w * minor(a, b);
}

bool isKnown(const Spot& spot) { return !spot.w.isZero(); }

bool areInLine(const std::array<const Spot*, 3>& spots, int axis) {
  const Spot &a = *spots[0], &b = *spots[1], &c = *spots[2];
  return isKnown(a) && isKnown(b) && isKnown(c) && areaOf(a, b, c, axis).isZero();
}

int exactTurn(const Context& context, const std::array<const Spot*, 3>& spots, int axis) {
  return areaOf(exactPoint(context, *spots[0]), exactPoint(context, *spots[1]), exactPoint(context, *spots[2]), axis).sign();
}

Triple<Bounded> difference(const Triple<Fine>& a, const Triple<Fine>& b) {
  return {Fine::difference(a[0], b[0]), Fine::difference(a[1], b[1]), Fine::difference(a[2], b[2])};
}

/// Where planes are nearly parallel, doubles leave too few digits; then the exact place is rounded. That pays, as one vertex is compared
/// with many.
Triple<Fine> finePlace(const Context& context, uint32_t v) {
  const auto q = Finder<Fine>(context).placeOf(v);
  const Triple<Fine> place{quotient(q.x[0], q.w), quotient(q.x[1], q.w), quotient(q.x[2], q.w)};
  const auto isFine = [&](size_t d) { return place[d].error() < 0x1p-40 * context.rounding[int(d)]; };
  if ((isFine(0) && isFine(1) && isFine(2)) || !context.exact.isKnown(v)) return place;
  const ExactPoint exact = exactVertex(context, v);
  const int power = exact.w.end();
  const Fine w = Fine::of(exact.w, power);
  return {quotient(Fine::of(exact.x[0], power), w), quotient(Fine::of(exact.x[1], power), w), quotient(Fine::of(exact.x[2], power), w)};
}

Fine fineHeight(const Triple<Fine>& p, const PlaneOf<Fine>& plane) { return dot(plane.normal, p) - plane.offset; }

}  // namespace

Spot spotOf(const Context& context, uint32_t v) { return {finePlace(context, v), context.exact[v], context.exact.isKnown(v) ? 1 : 0, v}; }

Spot middle(const Spot& a, const Spot& b) {
  return {Fine(0.5) * (a.place + b.place), b.w * a.x + a.w * b.x, Residue(2) * a.w * b.w, 0, {&a, &b}};
}

Spot meet(const Context& context, const Spot& a, const Spot& b, size_t triangle) {
  const PlaneOf<Fine> plane = Finder<Fine>(context).planeOf(triangle);
  const Fine above = fineHeight(a.place, plane), below = fineHeight(b.place, plane);
  Spot spot{{Fine::unknown(), Fine::unknown(), Fine::unknown()}, {}, {}, 0, {&a, &b}, int64_t(triangle)};
  // Bounds may leave a side open, and in a wrong mesh the sides may be the same or the places unknown.
  if (!isKnown(a) || !isKnown(b) || above.bounded().sign() * below.bounded().sign() >= 0) return spot;
  spot.place = a.place + quotient(above, above - below) * (b.place - a.place);
  const ExactPlane& its = context.exact.planeOf(triangle);
  const Residue high = dot(its.normal, a.x) - its.offset, low = dot(its.normal, b.x) - its.offset;  // w of a vertex is 1
  spot.x = high * b.x - low * a.x;
  spot.w = high - low;
  return spot;
}

FinePlane finePlane(const Context& context, size_t triangle, const Spot& origin) {
  const PlaneOf<Fine> plane = Finder<Fine>(context).planeOf(triangle);
  const Triple<Bounded> normal{plane.normal[0].bounded(), plane.normal[1].bounded(), plane.normal[2].bounded()};
  return {normal, origin.place, fineHeight(origin.place, plane).bounded(), triangle};
}

int sideOf(const Context& context, const FinePlane& plane, const Spot& spot) {
  const int side = (dot(plane.normal, difference(spot.place, plane.origin)) + plane.height).sign();
  if (side != 0) return side;
  if (!plane.exact) plane.exact = Finder<Exact>(context).planeOf(plane.triangle);
  return heightOf(exactPoint(context, spot), *plane.exact).sign();
}

int turn(const Context& context, const std::array<const Spot*, 3>& spots, int axis) {
  const size_t d = size_t(axis + 1) % 3, e = size_t(axis + 2) % 3;
  const Triple<Fine>&a = spots[0]->place, &b = spots[1]->place, &c = spots[2]->place;
  const auto minor =
      Fine::difference(b[d], a[d]) * Fine::difference(c[e], a[e]) - Fine::difference(b[e], a[e]) * Fine::difference(c[d], a[d]);
  const int sign = minor.sign();
  return sign != 0 ? sign : areInLine(spots, axis) ? 0 : exactTurn(context, spots, axis);
}

int compare(const Context& context, const Spot& a, const Spot& b, int axis) {
  const int sign = Fine::difference(a.place[size_t(axis)], b.place[size_t(axis)]).sign();
  if (sign != 0) return sign;
  if (isKnown(a) && isKnown(b) && a.x[size_t(axis)] * b.w == b.x[size_t(axis)] * a.w) return 0;
  const ExactPoint &p = exactPoint(context, a), &q = exactPoint(context, b);
  return (p.x[size_t(axis)] * q.w - q.x[size_t(axis)] * p.w).sign();
}

bool areSurelySkew(const std::array<const Spot*, 4>& spots) {
  const auto from = [&](size_t i) { return difference(spots[i]->place, spots[0]->place); };
  return dot(cross(from(1), from(2)), from(3)).sign() != 0;
}

}  // namespace mandoline::validation
