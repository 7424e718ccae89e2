// The points of an arrangement: tri-vertices, whose coordinates are doubles, and after them made points, where edges and triangles
// meet. A made point has approximate coordinates with proven errors, and exact ones on demand, as polynomials of the input's doubles.
#pragma once

#include <type_traits>

#include "mesh/resolve/contact.h"
#include "mesh/resolve/lines.h"

namespace mandoline::detail {

class MeshPoints {
 public:
  explicit MeshPoints(const WeldedMesh& mesh) : mesh_(&mesh), firstMade_(uint32_t(mesh.points.size())) {}

  /// Adds the point of a key that is not a tri-vertex; place(id) has to follow.
  uint32_t add(const PointKey& key) {
    made_.push_back({key, {}});
    return firstMade_ + uint32_t(made_.size()) - 1;
  }
  /// Adds a made point of another arrangement, which has the key here; nothing else has to follow.
  void addSame(const MeshPoints& other, uint32_t id, const PointKey& key) {
    made_.push_back({key, other.made_[id - other.firstMade_].approximate});
  }
  /// Finds the approximate coordinates of a made point. Different ones may be placed at the same time.
  void place(uint32_t id, Predicates& predicates);

  uint32_t firstMade() const { return firstMade_; }
  uint32_t size() const { return firstMade_ + uint32_t(made_.size()); }
  bool isMade(uint32_t v) const { return v >= firstMade_; }
  const PointKey& key(uint32_t v) const { return made_[v - firstMade_].key; }
  /// A double point at or near the point.
  Point reference(uint32_t v) const;
  /// A coordinate with its error.
  Bounded approximate(uint32_t v, int axis) const {
    return isMade(v) ? made_[v - firstMade_].approximate[size_t(axis)] : Bounded(mesh_->points[v][size_t(axis)]);
  }

  template <class Number>
  Homogeneous<Number> point(uint32_t v, const Point& reference) const;

  /// Order along an axis.
  int compare(uint32_t u, uint32_t v, int axis, Predicates& predicates) const;
  /// Order along an axis against a plane's coordinate.
  int compareWith(uint32_t v, int axis, double coordinate, Predicates& predicates) const;
  /// Whether u, v, w turn counter-clockwise (1) about +axis.
  int orient(uint32_t u, uint32_t v, uint32_t w, int axis, Predicates& predicates) const;
  /// Side of a triangle's plane; positive where the normal points to.
  int sideOfPlane(uint32_t triangle, uint32_t v, Predicates& predicates) const;

 private:
  struct Made {
    PointKey key;
    std::array<Bounded, 3> approximate;
  };
  template <class Number>
  Homogeneous<Number> madePoint(const PointKey& key, const Point& reference) const;
  template <class Number>
  Homogeneous<Number> edgeTrianglePoint(const PointKey& key, const Point& reference) const;
  template <class Number>
  Homogeneous<Number> edgeEdgePoint(const PointKey& key, const Point& reference) const;
  bool liesOn(const PointKey& key, uint32_t triangle) const;

  const WeldedMesh* mesh_;
  uint32_t firstMade_;
  std::vector<Made> made_;
};

template <class Number>
Homogeneous<Number> MeshPoints::edgeTrianglePoint(const PointKey& key, const Point& reference) const {
  const Point &a = mesh_->points[key.ids[0]], &b = mesh_->points[key.ids[1]];
  const Plane<Number> plane = planeOf<Number>(*mesh_, key.ids[2], a);  // its offset is the height of the triangle above a
  const Vector3<Number> along = difference<Number>(b, a);
  Homogeneous<Number> h;
  h.w = dot(plane.normal, along);
  for (int d = 0; d < 3; ++d) h.x[d] = Number::difference(a[size_t(d)], reference[size_t(d)]) * h.w + plane.offset * along.x[d];
  return h;
}

template <class Number>
Homogeneous<Number> MeshPoints::edgeEdgePoint(const PointKey& key, const Point& reference) const {
  const Point &a = mesh_->points[key.ids[0]], &b = mesh_->points[key.ids[1]], &c = mesh_->points[key.ids[2]],
              &d = mesh_->points[key.ids[3]];
  const Vector3<Number> along = difference<Number>(b, a), other = difference<Number>(d, c), between = difference<Number>(c, a);
  const Vector3<Number> normal = cross(along, other), toward = cross(between, other);  // parallel: the edges lie in one plane
  const Number part = dot(toward, normal);
  Homogeneous<Number> h;
  h.w = dot(normal, normal);
  for (int e = 0; e < 3; ++e) h.x[e] = Number::difference(a[size_t(e)], reference[size_t(e)]) * h.w + part * along.x[e];
  return h;
}

template <class Number>
Homogeneous<Number> MeshPoints::madePoint(const PointKey& key, const Point& reference) const {
  Homogeneous<Number> h = key.kind == PointKey::Kind::edgeTriangle ? edgeTrianglePoint<Number>(key, reference)
                          : key.kind == PointKey::Kind::edgeEdge
                              ? edgeEdgePoint<Number>(key, reference)
                              : meetingPoint(planeOf<Number>(*mesh_, key.ids[0], reference), planeOf<Number>(*mesh_, key.ids[1], reference),
                                             planeOf<Number>(*mesh_, key.ids[2], reference));
  if (h.w.sign() < 0) {
    h.w = -h.w;
    for (Number& x : h.x) x = -x;
  }
  return h;
}

template <class Number>
Homogeneous<Number> MeshPoints::point(uint32_t v, const Point& reference) const {
  Homogeneous<Number> h;
  h.w = Number(1);
  if (!isMade(v)) {
    for (int d = 0; d < 3; ++d) h.x[d] = Number::difference(mesh_->points[v][size_t(d)], reference[size_t(d)]);
  } else if constexpr (std::is_same_v<Number, Bounded>) {
    for (int d = 0; d < 3; ++d) h.x[d] = approximate(v, d) - Bounded(reference[size_t(d)]);
  } else {
    h = madePoint<Number>(key(v), reference);
  }
  return h;
}

}  // namespace mandoline::detail
