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

const PlaneOf<Exact>& exactPlane(const Context& context, const FinePlane& plane) {
  if (!plane.exact) plane.exact = Finder<Exact>(context).planeOf(plane.triangle);
  return *plane.exact;
}

ExactPoint madeExactly(const Context& context, const Spot& spot);

const ExactPoint& exactPoint(const Context& context, const Spot& spot) {
  if (!spot.exact) spot.exact = madeExactly(context, spot);
  return *spot.exact;
}

ExactPoint madeExactly(const Context& context, const Spot& spot) {
  if (!spot.ends[0]) return exactVertex(context, spot.vertex);
  const ExactPoint &a = exactPoint(context, *spot.ends[0]), &b = exactPoint(context, *spot.ends[1]);
  if (!spot.plane) return {b.w * a.x + a.w * b.x, Exact(2) * a.w * b.w};
  const PlaneOf<Exact>& plane = exactPlane(context, *spot.plane);
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

Triple<Finest> madeFinest(const Context& context, const Spot& spot);

const Triple<Finest>& finestPlace(const Context& context, const Spot& spot) {
  if (!spot.finest) spot.finest = madeFinest(context, spot);
  return *spot.finest;
}

/// An exact point, rounded.
Finest finestOf(const ExactPoint& point, size_t d) {
  const int power = point.w.end();
  const Fine w = Fine::of(point.w, power);
  const double base = quotient(Fine::of(point.x[d], power), w).bounded().value;
  return {base, quotient(Fine::of(point.x[d] - Exact(base) * point.w, power), w)};
}

Triple<Fine> fineDifference(const Context& context, const Spot& a, const Spot& b) {
  const Triple<Finest>&p = finestPlace(context, a), &q = finestPlace(context, b);
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

Fine fineHeight(const Context& context, const FinePlane& plane, const Spot& spot) {
  return plane.holdsOrigin ? dot(plane.fine.normal, fineDifference(context, spot, *plane.origin)) : Fine::unknown();
}

Triple<Finest> madeFinest(const Context& context, const Spot& spot) {
  const Finest unknown{0, Fine::unknown()};
  if (!isKnown(spot)) return {unknown, unknown, unknown};
  if (!spot.ends[0]) {
    const ExactPoint& point = exactPoint(context, spot);
    return {finestOf(point, 0), finestOf(point, 1), finestOf(point, 2)};
  }
  const Spot &a = *spot.ends[0], &b = *spot.ends[1];
  Fine share = 0.5;
  if (spot.plane) {
    const Fine above = fineHeight(context, *spot.plane, a), below = fineHeight(context, *spot.plane, b);
    share = quotient(above, above - below);
  }
  const Triple<Fine> along = share * fineDifference(context, b, a);
  Triple<Finest> place = finestPlace(context, a);
  for (size_t d = 0; d < 3; ++d) place[d].rest = place[d].rest + along[d];
  return place;
}

int finestTurn(const Context& context, const std::array<const Spot*, 3>& spots, int axis) {
  const size_t d = size_t(axis + 1) % 3, e = size_t(axis + 2) % 3;
  const Triple<Fine> b = fineDifference(context, *spots[1], *spots[0]), c = fineDifference(context, *spots[2], *spots[0]);
  return (b[d] * c[e] - b[e] * c[d]).bounded().sign();
}

}  // namespace

Spot spotOf(const Context& context, uint32_t v) { return {finePlace(context, v), context.exact[v], context.exact.isKnown(v) ? 1 : 0, v}; }

Spot middle(const Spot& a, const Spot& b) {
  return {Fine(0.5) * (a.place + b.place), b.w * a.x + a.w * b.x, Residue(2) * a.w * b.w, 0, {&a, &b}};
}

Spot meet(const Context& context, const Spot& a, const Spot& b, const FinePlane& plane) {
  const Fine above = fineHeight(a.place, plane.fine), below = fineHeight(b.place, plane.fine);
  Spot spot{a.place + quotient(above, above - below) * (b.place - a.place), {}, {}, 0, {&a, &b}, &plane};
  if (!isKnown(a) || !isKnown(b)) return spot;
  const ExactPlane& its = context.exact.planeOf(plane.triangle);
  const Residue high = dot(its.normal, a.x) - its.offset, low = dot(its.normal, b.x) - its.offset;  // w of a vertex is 1
  spot.x = high * b.x - low * a.x;
  spot.w = high - low;
  return spot;
}

FinePlane finePlane(const Context& context, size_t triangle, const Spot& origin) {
  const PlaneOf<Fine> plane = Finder<Fine>(context).planeOf(triangle);
  const Triple<Bounded> normal{plane.normal[0].bounded(), plane.normal[1].bounded(), plane.normal[2].bounded()};
  const bool holdsOrigin = isKnown(origin) && context.inPlane(origin.vertex, triangle);
  return {normal, fineHeight(origin.place, plane).bounded(), &origin, triangle, plane, holdsOrigin};
}

int sideOf(const Context& context, const FinePlane& plane, const Spot& spot) {
  int side = (dot(plane.normal, difference(spot.place, plane.origin->place)) + plane.height).sign();
  if (side == 0) side = fineHeight(context, plane, spot).bounded().sign();
  return side != 0 ? side : heightOf(exactPoint(context, spot), exactPlane(context, plane)).sign();
}

int turn(const Context& context, const std::array<const Spot*, 3>& spots, int axis) {
  const size_t d = size_t(axis + 1) % 3, e = size_t(axis + 2) % 3;
  const Triple<Fine>&a = spots[0]->place, &b = spots[1]->place, &c = spots[2]->place;
  const auto minor =
      Fine::difference(b[d], a[d]) * Fine::difference(c[e], a[e]) - Fine::difference(b[e], a[e]) * Fine::difference(c[d], a[d]);
  int sign = minor.sign();
  if (sign != 0) return sign;
  if (areInLine(spots, axis)) return 0;
  sign = finestTurn(context, spots, axis);
  return sign != 0 ? sign : exactTurn(context, spots, axis);
}

int compare(const Context& context, const Spot& a, const Spot& b, int axis) {
  int sign = Fine::difference(a.place[size_t(axis)], b.place[size_t(axis)]).sign();
  if (sign != 0) return sign;
  if (isKnown(a) && isKnown(b) && a.x[size_t(axis)] * b.w == b.x[size_t(axis)] * a.w) return 0;
  sign = (finestPlace(context, a)[size_t(axis)] - finestPlace(context, b)[size_t(axis)]).bounded().sign();
  if (sign != 0) return sign;
  const ExactPoint &p = exactPoint(context, a), &q = exactPoint(context, b);
  return (p.x[size_t(axis)] * q.w - q.x[size_t(axis)] * p.w).sign();
}

bool areSurelySkew(const std::array<const Spot*, 4>& spots) {
  const auto from = [&](size_t i) { return difference(spots[i]->place, spots[0]->place); };
  return dot(cross(from(1), from(2)), from(3)).sign() != 0;
}

}  // namespace mandoline::validation
