#include "mesh/resolve/mesh_points.h"

#include <algorithm>

namespace mandoline::detail {

void MeshPoints::place(uint32_t id, Predicates& predicates) {
  Made& made = made_[id - firstMade_];
  const Point reference =
      mesh_->points[made.key.kind == PointKey::Kind::triangles ? mesh_->triangles[made.key.ids[0]][0] : made.key.ids[0]];
  const auto near = madePoint<Bounded>(made.key, reference);
  bool good = true;
  for (size_t d = 0; d < 3; ++d) {
    made.approximate[d] = quotient(near.x[d], near.w) + Bounded(reference[d]);
    good &= made.approximate[d].error <= 16 * kRoundoff * std::max(std::fabs(made.approximate[d].value), std::fabs(reference[d]));
  }
  if (good) return;
  ++predicates.fallbacks;
  const auto exact = madePoint<Big>(made.key, {0, 0, 0});
  for (size_t d = 0; d < 3; ++d) {
    const double x = Big::quotient(exact.x[d], exact.w);
    made.approximate[d] = {x, 16 * kRoundoff * std::fabs(x)};
  }
}

Point MeshPoints::reference(uint32_t v) const {
  if (!isMade(v)) return mesh_->points[v];
  const auto& x = made_[v - firstMade_].approximate;
  return {x[0].value, x[1].value, x[2].value};
}

int MeshPoints::compare(uint32_t u, uint32_t v, int axis, Predicates& predicates) const {
  if (u == v) return 0;
  const Bounded near = approximate(u, axis) - approximate(v, axis);
  if (near.certain()) return near.sign();
  ++predicates.fallbacks;
  const auto a = point<Big>(u, {0, 0, 0}), b = point<Big>(v, {0, 0, 0});
  return (a.x[axis] * b.w - b.x[axis] * a.w).sign();
}

int MeshPoints::compareWith(uint32_t v, int axis, double coordinate, Predicates& predicates) const {
  const Bounded near = approximate(v, axis) - Bounded(coordinate);
  if (near.certain()) return near.sign();
  ++predicates.fallbacks;
  const auto a = point<Big>(v, {0, 0, 0});
  return (a.x[axis] - Big(coordinate) * a.w).sign();
}

int MeshPoints::orient(uint32_t u, uint32_t v, uint32_t w, int axis, Predicates& predicates) const {
  if (!isMade(u) && !isMade(v) && !isMade(w)) {
    const size_t p = size_t(axis + 1) % 3, q = size_t(axis + 2) % 3;
    const Point &a = mesh_->points[u], &b = mesh_->points[v], &c = mesh_->points[w];
    return predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]});
  }
  const Point r = reference(u);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    return orientation<Number>(point<Number>(u, r), point<Number>(v, r), point<Number>(w, r), axis);
  });
}

/// Whether a point lies on a triangle's plane because of what made it.
bool MeshPoints::liesOn(const PointKey& key, uint32_t triangle) const {
  const auto& t = mesh_->triangles[triangle];
  const auto isCorner = [&](uint32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); };
  switch (key.kind) {
    case PointKey::Kind::vertex:
      return isCorner(key.ids[0]);
    case PointKey::Kind::edgeTriangle:
      return key.ids[2] == triangle || (isCorner(key.ids[0]) && isCorner(key.ids[1]));
    case PointKey::Kind::edgeEdge:
      return (isCorner(key.ids[0]) && isCorner(key.ids[1])) || (isCorner(key.ids[2]) && isCorner(key.ids[3]));
    case PointKey::Kind::triangles:
      return std::find(key.ids.begin(), key.ids.begin() + 3, triangle) != key.ids.begin() + 3;
  }
  return false;
}

int MeshPoints::sideOfPlane(uint32_t triangle, uint32_t v, Predicates& predicates) const {
  const auto& t = mesh_->triangles[triangle];
  const Point &a = mesh_->points[t[0]], &b = mesh_->points[t[1]], &c = mesh_->points[t[2]];
  if (!isMade(v)) {
    if (std::find(t.begin(), t.end(), v) != t.end()) return 0;
    return predicates.orient3d(a.data(), b.data(), c.data(), mesh_->points[v].data());
  }
  if (liesOn(key(v), triangle)) return 0;
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto h = point<Number>(v, a);
    const Vector3<Number> normal = normalOf<Number>(a, b, c);
    return normal.x[0] * h.x[0] + normal.x[1] * h.x[1] + normal.x[2] * h.x[2];
  });
}

}  // namespace mandoline::detail
