#include "cut/predicates/inner_point.h"

namespace mandoline::detail {
namespace {

template <class Number>
Number normalAlong(const Corners& t, int axis) {
  const Point &a = *t[0], &b = *t[1], &c = *t[2];
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  const auto diff = &Number::difference;
  return diff(b[p], a[p]) * diff(c[q], a[q]) - diff(b[q], a[q]) * diff(c[p], a[p]);
}

int sideOfPlane(const Corners& t, const InnerPoint& point, int axis, const double* replaced, Predicates& predicates) {
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const Point& a = *t[0];
    Number sum(0);
    for (int d = 0; d < 3; ++d) {
      const Number x =
          d == axis && replaced ? Number::difference(*replaced, a[d]) * point.weight<Number>() : point.coordinate<Number>(d, a[d]);
      sum = sum + normalAlong<Number>(t, d) * x;
    }
    return sum;
  });
}

}  // namespace

int volumeSign(const std::vector<Corners>& triangles, Predicates& predicates) {
  if (triangles.empty()) return 0;
  const Point& r = *triangles[0][0];
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    Number sum(0);
    for (const Corners& t : triangles) {
      Number x[3][3];
      for (int k = 0; k < 3; ++k) {
        for (int d = 0; d < 3; ++d) x[k][d] = Number::difference((*t[k])[d], r[d]);
      }
      sum = sum + x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) - x[0][1] * (x[1][0] * x[2][2] - x[1][2] * x[2][0]) +
            x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0]);
    }
    return sum;
  });
}

int normalSign(const Corners& t, int axis, Predicates& predicates) {
  const Point &a = *t[0], &b = *t[1], &c = *t[2];
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  return predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]});
}

int insideOf(const Corners& t, const InnerPoint& point, int axis, Predicates& predicates) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  bool left = false, right = false, on = false;
  for (int i = 0; i < 3; ++i) {
    const Point &a = *t[i], &b = *t[(i + 1) % 3];
    const int side = predicates.sign([&](auto number) {
      using Number = decltype(number);
      return Number::difference(b[p], a[p]) * point.coordinate<Number>(q, a[q]) -
             Number::difference(b[q], a[q]) * point.coordinate<Number>(p, a[p]);
    });
    left |= side > 0;
    right |= side < 0;
    on |= side == 0;
  }
  return left && right ? -1 : on ? 0 : 1;
}

int sideOfPlane(const Corners& t, const InnerPoint& point, Predicates& predicates) { return sideOfPlane(t, point, 0, nullptr, predicates); }

int sideOfPlane(const Corners& t, const InnerPoint& point, int axis, double coordinate, Predicates& predicates) {
  return sideOfPlane(t, point, axis, &coordinate, predicates);
}

int compareHeights(const Corners& t, const Corners& u, const InnerPoint& point, int axis, Predicates& predicates) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  const double r = (*t[0])[axis];
  const int sign = predicates.sign([&](auto number) {
    using Number = decltype(number);
    Number height[2], normal[2];  // height times weight times normal
    for (int i = 0; i < 2; ++i) {
      const Corners& v = i == 0 ? t : u;
      const Point& a = *v[0];
      normal[i] = normalAlong<Number>(v, axis);
      height[i] =
          Number::difference(a[axis], r) * normal[i] * point.weight<Number>() -
          (normalAlong<Number>(v, p) * point.coordinate<Number>(p, a[p]) + normalAlong<Number>(v, q) * point.coordinate<Number>(q, a[q]));
    }
    return height[0] * normal[1] - height[1] * normal[0];
  });
  return sign * normalSign(t, axis, predicates) * normalSign(u, axis, predicates);
}

bool isAbove(const CutVertices& vertices, uint32_t v, const InnerPoint& point, int axis, Predicates& predicates) {
  const int q = (axis + 2) % 3;
  const Point r = vertices.reference(v);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto h = vertices.point<Number>(v, r, predicates);
    return h.x[q] * point.weight<Number>() - point.coordinate<Number>(q, r[q]) * h.w;
  }) > 0;
}

int sideOfLine(const CutVertices& vertices, const std::array<uint32_t, 2>& line, const InnerPoint& point, int axis,
               Predicates& predicates) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  const Point r = vertices.reference(line[0]);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto a = vertices.point<Number>(line[0], r, predicates), b = vertices.point<Number>(line[1], r, predicates);
    const Number x = point.coordinate<Number>(p, r[p]), y = point.coordinate<Number>(q, r[q]), w = point.weight<Number>();
    return a.x[p] * (b.x[q] * w - y * b.w) - a.x[q] * (b.x[p] * w - x * b.w) + a.w * (b.x[p] * y - b.x[q] * x);
  });
}

}  // namespace mandoline::detail
