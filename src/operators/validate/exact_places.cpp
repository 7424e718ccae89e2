#include "operators/validate/exact_places.h"

#include "operators/validate/context.h"

namespace mandoline::validation {
namespace {

bool isZero(const Residue& x) { return x.isZero(); }
bool isZero(const Exact& x) { return x.sign() == 0; }

/// Finds places in numbers of one kind.
template <class Number>
class Finder {
 public:
  using Point = Triple<Number>;
  using Plane = PlaneOf<Number>;
  /// The point x / w; no point if w is 0.
  struct Quotient {
    Point x;
    Number w;
  };

  explicit Finder(const Context& context) : x_(context) {}

  Plane planeOf(size_t triangle) const {
    const uint32_t* corners = &x_.mesh.triangles[3 * triangle];
    const Point a = triVertex(corners[0]), normal = cross(triVertex(corners[1]) - a, triVertex(corners[2]) - a);
    return {normal, dot(normal, a)};
  }

  Quotient placeOf(uint32_t v) const {
    const CutMesh& cut = x_.cut;
    const int32_t tri = cut.vertexTriVertex[v], a = cut.vertexParents[2 * size_t(v)], b = cut.vertexParents[2 * size_t(v) + 1];
    if (tri >= 0) return {triVertex(uint32_t(tri)), 1};
    if (cut.vertexMask[v] == 7) return {{onPlane(v, 0), onPlane(v, 1), onPlane(v, 2)}, 1};
    if (b >= 0) return placeOnEdge(v, triVertex(uint32_t(a)), triVertex(uint32_t(b)));
    if (a >= 0) return placeInTriangle(v, size_t(a));
    const int64_t made = x_.madeIndex(v);
    return made >= 0 ? placeOfMade(v, size_t(made)) : Quotient{};
  }

 private:
  Point triVertex(uint32_t v) const {
    const Vec3 p = x_.triVertex(v);
    return {p[0], p[1], p[2]};
  }
  Number onPlane(uint32_t v, int axis) const { return x_.planes()[size_t(axis)][size_t(x_.cellAt(v)[axis])]; }
  Plane axialPlane(uint32_t v, int axis) const {
    Plane plane{{}, onPlane(v, axis)};
    plane.normal[size_t(axis)] = 1;
    return plane;
  }

  static Quotient meet(const Plane& p, const Plane& q, const Plane& r) {
    const Point qr = cross(q.normal, r.normal), rp = cross(r.normal, p.normal), pq = cross(p.normal, q.normal);
    return {p.offset * qr + q.offset * rp + r.offset * pq, dot(p.normal, qr)};
  }
  /// Where the line through a and b meets a plane.
  static Quotient meet(const Point& a, const Point& b, const Plane& plane) {
    const Number from = plane.offset - dot(plane.normal, a), to = dot(plane.normal, b) - plane.offset;
    return {to * a + from * b, from + to};
  }
  /// Where two lines in one plane meet.
  static Quotient meet(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point area = cross(b - a, d - c), part = cross(c - a, d - c);
    size_t axis = 0;
    while (axis < 2 && isZero(area[axis])) ++axis;
    return {area[axis] * a + part[axis] * (b - a), area[axis]};
  }

  /// Where a tri-edge meets the first plane of the vertex that it does not lie in.
  Quotient placeOnEdge(uint32_t v, const Point& a, const Point& b) const {
    int axis = 0;
    while (axis < 2 && (!x_.onPlane(v, axis) || isZero(a[size_t(axis)] - b[size_t(axis)]))) ++axis;
    return meet(a, b, axialPlane(v, axis));
  }
  /// Where a triangle meets the grid line that the vertex lies on.
  Quotient placeInTriangle(uint32_t v, size_t triangle) const {
    int along = 0;
    while (along < 2 && x_.onPlane(v, along)) ++along;
    return meet(axialPlane(v, (along + 1) % 3), axialPlane(v, (along + 2) % 3), planeOf(triangle));
  }
  /// Where two triangles meet the first plane of the vertex for which that is a point.
  Quotient placeInTwoTriangles(uint32_t v, const Plane& s, const Plane& t) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (!x_.onPlane(v, axis)) continue;
      const Quotient q = meet(s, t, axialPlane(v, axis));
      if (!isZero(q.w)) return q;
    }
    return {};
  }
  Quotient placeOfMade(uint32_t v, size_t made) const {
    const int32_t* parents = &x_.cut.madeVertexParents[4 * made];
    const auto corner = [&](int i) { return triVertex(uint32_t(parents[i])); };
    const auto plane = [&](int i) { return planeOf(size_t(parents[i])); };
    switch (MadeVertex(x_.cut.madeVertexKinds[made])) {
      case MadeVertex::edgeTriangle:
        return meet(corner(0), corner(1), plane(2));
      case MadeVertex::edgeEdge:
        return meet(corner(0), corner(1), corner(2), corner(3));
      case MadeVertex::triangles:
        return meet(plane(0), plane(1), plane(2));
      default:
        return placeInTwoTriangles(v, plane(0), plane(1));
    }
  }

  const Context& x_;
};

/// dot(normal, p) - offset at a point, times its w.
Exact heightOf(const ExactPoint& p, const PlaneOf<Exact>& plane) { return dot(plane.normal, p.x) - plane.offset * p.w; }

}  // namespace

ExactPlane exactPlane(const Context& context, size_t triangle) { return Finder<Residue>(context).planeOf(triangle); }

/// One inverse is enough: that of the product of all divisors.
ExactPlaces::ExactPlaces(const Context& context) {
  const Finder<Residue> finder(context);
  const uint32_t count = uint32_t(context.cut.vertexCount());
  std::vector<Residue> divisors(count), products(size_t(count) + 1);
  places_.resize(count);
  known_.resize(count);
  products[0] = 1;
  for (uint32_t v = 0; v < count; ++v) {
    const auto q = finder.placeOf(v);
    known_[v] = !q.w.isZero();
    places_[v] = q.x;
    divisors[v] = known_[v] ? q.w : Residue(1);
    products[v + 1] = products[v] * divisors[v];
  }
  Residue inverse = products[count].inverse();
  for (uint32_t v = count; v-- > 0;) {
    places_[v] = (inverse * products[v]) * places_[v];
    inverse = inverse * divisors[v];
  }
}

ExactPoint exactPoint(const Context& context, uint32_t v) {
  const auto q = Finder<Exact>(context).placeOf(v);
  const Exact sign = q.w.sign();
  return {sign * q.x, sign * q.w};
}

ExactPoint middle(const ExactPoint& a, const ExactPoint& b) { return {b.w * a.x + a.w * b.x, Exact(2) * a.w * b.w}; }

ExactPoint meet(const Context& context, const ExactPoint& a, const ExactPoint& b, size_t triangle) {
  const PlaneOf<Exact> plane = Finder<Exact>(context).planeOf(triangle);
  const Exact above = heightOf(a, plane), below = heightOf(b, plane), sign = above.sign();
  return {(sign * above) * b.x - (sign * below) * a.x, (sign * above) * b.w - (sign * below) * a.w};
}

int sideOf(const Context& context, const ExactPoint& p, size_t triangle) {
  return heightOf(p, Finder<Exact>(context).planeOf(triangle)).sign();
}

int turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int axis) {
  const size_t d = size_t(axis + 1) % 3, e = size_t(axis + 2) % 3;
  const auto minor = [&](const ExactPoint& p, const ExactPoint& q) { return p.x[d] * q.x[e] - p.x[e] * q.x[d]; };
  return (a.w * minor(b, c) + b.w * minor(c, a) + c.w * minor(a, b)).sign();
}

int compare(const ExactPoint& a, const ExactPoint& b, int axis) { return (a.x[size_t(axis)] * b.w - b.x[size_t(axis)] * a.w).sign(); }

}  // namespace mandoline::validation
