#include "cut/predicates/cut_vertices.h"

#include <cmath>

namespace mandoline::detail {

Point CutVertices::reference(uint32_t v) const {
  if (isTriVertex(v)) return input->points[v];
  if (isOnEdge(v)) return input->points[(*triEdges)[triEdge(v)][0]];
  if (isInTriangle(v)) return input->points[input->triangles[triangle(v)][0]];
  Point p;
  for (int d = 0; d < 3; ++d) p[d] = input->planes[d][slabs[v][d] >> 1];
  return p;
}

int CutVertices::compare(uint32_t u, uint32_t v, int axis, Predicates& predicates) const {
  const int32_t su = slabs[u][axis], sv = slabs[v][axis];
  if (su != sv || onPlane(su)) return (su > sv) - (su < sv);
  if (isTriVertex(u) && isTriVertex(v)) return signOf(input->points[u][axis] - input->points[v][axis]);
  const Point r = reference(u);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto a = point<Number>(u, r, predicates), b = point<Number>(v, r, predicates);
    return a.x[axis] * b.w - b.x[axis] * a.w;
  });
}

int CutVertices::orient(uint32_t u, uint32_t v, uint32_t w, int axis, Predicates& predicates) const {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  if (isTriVertex(u) && isTriVertex(v) && isTriVertex(w)) {
    const Point &a = input->points[u], &b = input->points[v], &c = input->points[w];
    return predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]});
  }
  const Point r = reference(u);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto a = point<Number>(u, r, predicates), b = point<Number>(v, r, predicates), c = point<Number>(w, r, predicates);
    return a.x[p] * (b.x[q] * c.w - c.x[q] * b.w) - a.x[q] * (b.x[p] * c.w - c.x[p] * b.w) + a.w * (b.x[p] * c.x[q] - b.x[q] * c.x[p]);
  });
}

CutVertices::Range CutVertices::range(uint32_t v, int axis, Predicates& predicates) const {
  if (isTriVertex(v)) return {input->points[v][axis], input->points[v][axis]};
  const auto& planes = input->planes[axis];
  const int32_t c = slabs[v][axis] >> 1;
  if (onPlane(slabs[v][axis])) return {planes[c], planes[c]};
  const Point r = reference(v);
  const auto h = point<Bounded>(v, r, predicates);
  if (!(h.w.value > 2 * h.w.error)) return {planes[c], planes[c + 1]};
  const double x = r[axis] + h.x[axis].value / h.w.value;
  const double error = 2 * (h.x[axis].error + std::fabs(h.x[axis].value / h.w.value) * h.w.error) / h.w.value +
                       8 * kRoundoff * (std::fabs(r[axis]) + std::fabs(x));
  return {x - error, x + error};
}

Point CutVertices::position(uint32_t v, Predicates& predicates) const {
  if (isTriVertex(v)) return input->points[v];
  Point p;
  for (int d = 0; d < 3; ++d) p[d] = input->planes[d][std::max(slabs[v][d] >> 1, 0)];
  if (planeCount(slabs[v]) == 3) return p;
  const Point r = reference(v);
  const auto h = point<Bounded>(v, r, predicates);
  for (int d = 0; d < 3; ++d) {
    if (onPlane(slabs[v][d])) continue;
    const double quotient = h.x[d].value / h.w.value;
    const double error = (h.x[d].error + std::fabs(quotient) * h.w.error) / (h.w.value - h.w.error);
    double x = r[d] + quotient;
    if (!(h.w.value > 2 * h.w.error) || error > 8 * kRoundoff * std::max(std::fabs(r[d]), std::fabs(x))) {  // it would show
      const auto exact = point<Expansion>(v, r, predicates);
      x = r[d] + Expansion::quotient(exact.x[d], exact.w);
    }
    // Strictly inside of the slab, so that vertices on different grid elements have different positions.
    const int32_t c = slabs[v][d] >> 1;
    const double low = input->planes[d][c], high = input->planes[d][c + 1];
    if (!(x > low && x < high)) x = x <= low ? std::min(std::nextafter(low, high), high) : std::max(std::nextafter(high, low), low);
    p[d] = x;
  }
  return p;
}

int64_t CutVertices::triangleAt(uint32_t v) const {
  if (isInTriangle(v)) return triangle(v);
  const uint32_t low = isTriVertex(v) ? v : isOnEdge(v) ? (*triEdges)[triEdge(v)][0] : ~0u;
  const uint32_t high = isOnEdge(v) ? (*triEdges)[triEdge(v)][1] : low;
  for (size_t t = 0; t < input->triangles.size(); ++t) {
    const auto& c = input->triangles[t];
    if (input->kept(t) && std::count(c.begin(), c.end(), low) && std::count(c.begin(), c.end(), high)) return int64_t(t);
  }
  for (size_t t = 0; t < input->triangles.size(); ++t) {  // an edge that only stitching made
    const auto& c = input->triangles[t];
    if (std::count(c.begin(), c.end(), low)) return int64_t(t);
  }
  return -1;
}

void CutVertices::failSelfIntersection(int64_t triangle, int64_t other) const {
  throw Failure{{Status::selfIntersection, triangle, other, {}}};
}

}  // namespace mandoline::detail
