#include "cut/predicates/inner_point.h"

namespace mandoline::detail {
namespace {

/// Coordinates relative to a double point.
template <class Number>
Homogeneous<Number> place(const CutVertices& vertices, const InnerPoint& point, const Point& reference, Predicates& predicates) {
  std::array<Homogeneous<Number>, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = vertices.point<Number>(point.corners[i], reference, predicates);
  Homogeneous<Number> h;
  h.w = Number(point.weights[0] + point.weights[1] + point.weights[2]) * corners[0].w * corners[1].w * corners[2].w;
  for (int d = 0; d < 3; ++d) {
    h.x[d] = Number(0);
    for (size_t i = 0; i < 3; ++i) {
      h.x[d] = h.x[d] + Number(point.weights[i]) * corners[i].x[d] * corners[(i + 1) % 3].w * corners[(i + 2) % 3].w;
    }
  }
  return h;
}

}  // namespace

std::array<Bounded, 3> approximate(const CutVertices& vertices, const InnerPoint& point, Predicates& predicates) {
  const Point r = vertices.reference(point.corners[0]);
  const auto h = place<Bounded>(vertices, point, r, predicates);
  return {quotient(h.x[0], h.w) + Bounded(r[0]), quotient(h.x[1], h.w) + Bounded(r[1]), quotient(h.x[2], h.w) + Bounded(r[2])};
}

Bounded approximateHeight(const CutVertices& vertices, TriangleId triangle, const InnerPoint& point, int axis, Predicates& predicates) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  const Point r = vertices.reference(point.corners[0]);
  const auto h = place<Bounded>(vertices, point, r, predicates);
  const auto [normal, offset] = planeOf<Bounded>(*vertices.input->mesh, triangle.number, r);
  const Bounded height = offset * h.w - (normal.x[p] * h.x[p] + normal.x[q] * h.x[q]);
  return quotient(height, normal.x[axis] * h.w) + Bounded(r[size_t(axis)]);
}

int compareHeights(const CutVertices& vertices, const std::array<TriangleId, 2>& triangles, const InnerPoint& point, int axis,
                   Predicates& predicates) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  const Point r = vertices.reference(point.corners[0]);
  const int sign = predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto h = place<Number>(vertices, point, r, predicates);
    Number height[2], normal[2];  // height times h.w times normal
    for (int i = 0; i < 2; ++i) {
      const auto plane = planeOf<Number>(*vertices.input->mesh, triangles[size_t(i)].number, r);
      normal[i] = plane.normal.x[axis];
      height[i] = plane.offset * h.w - (plane.normal.x[p] * h.x[p] + plane.normal.x[q] * h.x[q]);
    }
    return height[0] * normal[1] - height[1] * normal[0];
  });
  const WeldedMesh& mesh = *vertices.input->mesh;
  return sign * normalSign(mesh, triangles[0], axis, predicates) * normalSign(mesh, triangles[1], axis, predicates);
}

bool isAbove(const CutVertices& vertices, VertexId v, const InnerPoint& point, int axis, Predicates& predicates) {
  const int q = (axis + 2) % 3;
  const Point r = vertices.reference(v);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto h = vertices.point<Number>(v, r, predicates), from = place<Number>(vertices, point, r, predicates);
    return h.x[q] * from.w - from.x[q] * h.w;
  }) > 0;
}

int sideOfLine(const CutVertices& vertices, const std::array<VertexId, 2>& line, const InnerPoint& point, int axis,
               Predicates& predicates) {
  const Point r = vertices.reference(line[0]);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto a = vertices.point<Number>(line[0], r, predicates), b = vertices.point<Number>(line[1], r, predicates);
    return orientation(a, b, place<Number>(vertices, point, r, predicates), axis);
  });
}

}  // namespace mandoline::detail
