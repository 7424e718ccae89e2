// Points and lines of an arrangement as polynomials of the input's doubles, for any number type.
#pragma once

#include <cstdint>

#include "base/exact.h"
#include "mesh/welded_mesh.h"

namespace mandoline::detail {

/// A vertex in homogeneous coordinates (x / w, y / w, z / w) relative to some double point; w > 0.
template <class Number>
struct Homogeneous {
  Number x[3];
  Number w;
};

template <class Number>
struct Vector3 {
  Number x[3];

  friend Vector3 cross(const Vector3& a, const Vector3& b) {
    return {{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
  }
  friend Number dot(const Vector3& a, const Vector3& b) { return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2]; }
};

/// Positive where a, b, c turn left, seen along an axis: as orient2d of (axis + 1, axis + 2).
template <class Number>
Number orientation(const Homogeneous<Number>& a, const Homogeneous<Number>& b, const Homogeneous<Number>& c, int axis) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  return a.x[p] * (b.x[q] * c.w - c.x[q] * b.w) - a.x[q] * (b.x[p] * c.w - c.x[p] * b.w) + a.w * (b.x[p] * c.x[q] - b.x[q] * c.x[p]);
}

/// a - b.
template <class Number>
Vector3<Number> difference(const Point& a, const Point& b) {
  return {{Number::difference(a[0], b[0]), Number::difference(a[1], b[1]), Number::difference(a[2], b[2])}};
}

template <class Number>
Vector3<Number> normalOf(const Point& a, const Point& b, const Point& c) {
  return cross(difference<Number>(b, a), difference<Number>(c, a));
}

/// Points x with normal . (x - reference) = offset.
template <class Number>
struct Plane {
  Vector3<Number> normal;
  Number offset;
};

/// The plane of a triangle.
template <class Number>
Plane<Number> planeOf(const WeldedMesh& mesh, uint32_t triangle, const Point& reference) {
  const auto& t = mesh.triangles[triangle];
  const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
  const Vector3<Number> normal = normalOf<Number>(a, b, c);
  return {normal, dot(normal, difference<Number>(a, reference))};
}

/// The point where three planes meet; its w may still be negative.
template <class Number>
Homogeneous<Number> meetingPoint(const Plane<Number>& p, const Plane<Number>& q, const Plane<Number>& r) {
  const Vector3<Number> qr = cross(q.normal, r.normal), rp = cross(r.normal, p.normal), pq = cross(p.normal, q.normal);
  Homogeneous<Number> h;
  h.w = dot(p.normal, qr);
  for (int d = 0; d < 3; ++d) h.x[d] = p.offset * qr.x[d] + q.offset * rp.x[d] + r.offset * pq.x[d];
  return h;
}

/// The line that an edge of the arrangement lies on, directed like the edge from its lower vertex to its higher.
struct Line {
  uint32_t a, b;  ///< two tri-vertices, or two triangles, whose normals' cross product is the direction
  bool ofPlanes = false;

  template <class Number>
  Vector3<Number> direction(const WeldedMesh& mesh) const {
    if (!ofPlanes) return difference<Number>(mesh.points[b], mesh.points[a]);
    const auto normal = [&](uint32_t t) {
      const auto& v = mesh.triangles[t];
      return normalOf<Number>(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
    };
    return cross(normal(a), normal(b));
  }
};

}  // namespace mandoline::detail
