// Where the parents of a vertex meet, in numbers of any kind.
#pragma once

#include <type_traits>

#include "operators/validate/context.h"
#include "operators/validate/fine.h"

namespace mandoline::validation {

inline bool isZero(const Residue& x) { return x.isZero(); }
inline bool isZero(const Exact& x) { return x.sign() == 0; }
/// What may be 0 without being known as 0 ends as a divisor, and its quotient is unknown.
inline bool isZero(const Fine& x) { return x.isZero(); }

/// A tri-vertex, or 0: those that no triangle has need not be finite, and a damaged cut-mesh may name them.
inline Vec3 finiteTriVertex(const Context& context, uint32_t v) {
  const Vec3 p = context.triVertex(v);
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]) ? p : Vec3{};
}

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

  Point triVertex(uint32_t v) const {
    if constexpr (std::is_same_v<Number, Residue>) {
      return x_.exact.triVertex(v);
    } else {
      const Vec3 p = finiteTriVertex(x_, v);
      return {p[0], p[1], p[2]};
    }
  }

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
  Number onPlane(uint32_t v, int axis) const {
    const size_t plane = size_t(x_.cellAt(v)[axis]);
    if constexpr (std::is_same_v<Number, Residue>) {
      return x_.exact.axialPlane(axis, plane);
    } else {
      return x_.planes()[size_t(axis)][plane];
    }
  }
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

}  // namespace mandoline::validation
