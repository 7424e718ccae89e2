#include "cut/predicates/cut_vertices.h"

#include <algorithm>
#include <cmath>

namespace mandoline::detail {
namespace {

// Coordinates that are not on planes are a reference's plus a quotient. The quick ways do in doubles what point<Bounded>() does to the
// values, in the same order, and bound its errors all at once: if their bound, in units of kRoundoff, is below the one of placeExactly(),
// so are those, and both give the same. A difference of coordinates is off by 1 of itself at most, a product by what both are off, and 1.
// Which axes a vertex is on a plane of can't be foretold, so there are few branches on that.

constexpr std::array<size_t, 5> kAxes{0, 1, 2, 0, 1};

/// Products are off by 3, their sum by 4 of their magnitudes, the quotient by 5.
bool placeOnLine(const Input& input, const Slab& slab, const Line& line, const Point& reference, Point& p) {
  const Point* const ends[2] = {&input.point({line.a}), &input.point({line.b})};
  const auto extent = [&](size_t d) { return std::fabs((*ends[1])[d] - (*ends[0])[d]); };
  size_t across = size_t(onPlane(slab[1])) + 2 * size_t(onPlane(slab[2]));
  if (planeCount(slab) > 1) {  // as in point()
    across = onPlane(slab[0]) ? 0 : 1;
    for (size_t d = across + 1; d < 3; ++d) {
      if (onPlane(slab[d]) && extent(d) > extent(across)) across = d;
    }
  }
  const bool descends = (*ends[0])[across] > (*ends[1])[across];
  const Point &low = *ends[descends], &high = *ends[!descends];
  const double width = high[across] - low[across], way = p[across] - low[across];
  bool isSure = true;
  for (size_t i = 1; i < 3; ++i) {
    const size_t d = kAxes[across + i];
    if (onPlane(slab[d])) continue;
    const double toLow = (low[d] - reference[d]) * width, along = way * (high[d] - low[d]);
    const double x = reference[d] + (toLow + along) / width;
    isSure &= std::fabs(toLow) + std::fabs(along) <= 1.5 * width * std::max(std::fabs(reference[d]), std::fabs(x));
    p[d] = x;
  }
  return isSure;
}

/// The normal is off by 4 of its products' magnitudes, the numerator by 8 of these times the ways to the planes.
bool placeInTriangle(const Input& input, const Slab& slab, TriangleId triangle, Point& p) {
  const auto t = input.verticesOf(triangle);
  const Point &a = input.point(t[0]), &b = input.point(t[1]), &c = input.point(t[2]);
  const size_t g = size_t(!onPlane(slab[1])) + 2 * size_t(!onPlane(slab[2])), e = kAxes[g + 1], f = kAxes[g + 2];  // along the grid line: g
  const double be = b[e] - a[e], bf = b[f] - a[f], bg = b[g] - a[g], ce = c[e] - a[e], cf = c[f] - a[f], cg = c[g] - a[g];
  const double g0 = be * cf, g1 = bf * ce, e0 = bf * cg, e1 = bg * cf, f0 = bg * ce, f1 = be * cg;
  const auto magnitude = [](double x, double y) { return std::fabs(x) + std::fabs(y); };
  const double toE = p[e] - a[e], toF = p[f] - a[f], normal = g0 - g1, normalMagnitude = magnitude(g0, g1);
  const double offset = -((e0 - e1) * toE + (f0 - f1) * toF) / normal, x = a[g] + offset;
  const double terms = magnitude(e0, e1) * std::fabs(toE) + magnitude(f0, f1) * std::fabs(toF);
  p[g] = x;
  return std::fabs(normal) > 0x1p-40 * normalMagnitude &&
         terms + 0.5 * std::fabs(offset) * normalMagnitude <= 0.99 * std::fabs(normal) * std::max(std::fabs(a[g]), std::fabs(x));
}

bool placeQuickly(const CutVertices& vertices, VertexId v, Point& p) {
  const Input& input = *vertices.input;
  if (vertices.isTriVertex(v)) return false;
  if (!vertices.isOnEdge(v)) return placeInTriangle(input, vertices.slab(v), vertices.triangle(v), p);
  const TriEdgeId edge = vertices.triEdge(v);
  const Line line = vertices.edges->line(edge);
  return !line.ofPlanes && placeOnLine(input, vertices.slab(v), line, input.point(vertices.edges->ends[edge][0]), p);
}

}  // namespace

CutVertices CutVertices::ofBrick(const CutVertices& surface) {
  CutVertices vertices;
  vertices.input = surface.input;
  vertices.edges = surface.edges;
  vertices.surface = &surface;
  vertices.firstOnEdge = surface.firstOnEdge;
  vertices.firstInTriangle = surface.firstInTriangle;
  vertices.firstOwn = {uint32_t(surface.size())};
  return vertices;
}

Point CutVertices::reference(VertexId v) const {
  if (isTriVertex(v)) return input->point(v);
  if (isOnEdge(v)) return input->point(edges->ends[triEdge(v)][0]);
  if (isInTriangle(v)) return input->point(input->verticesOf(triangle(v))[0]);
  Point p;
  for (int d = 0; d < 3; ++d) p[d] = input->planes[d][slab(v)[d] >> 1];
  return p;
}

int CutVertices::compare(VertexId u, VertexId v, int axis, Predicates& predicates) const {
  const int32_t su = slab(u)[axis], sv = slab(v)[axis];
  if (su != sv || onPlane(su)) return (su > sv) - (su < sv);
  if (isTriVertex(u) && isTriVertex(v) && !input->mesh->isMade(u) && !input->mesh->isMade(v))
    return signOf(input->point(u)[axis] - input->point(v)[axis]);
  const Point r = reference(u);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto a = point<Number>(u, r, predicates), b = point<Number>(v, r, predicates);
    return a.x[axis] * b.w - b.x[axis] * a.w;
  });
}

int CutVertices::orient(VertexId u, VertexId v, VertexId w, int axis, Predicates& predicates) const {
  const auto isDouble = [&](VertexId x) { return isTriVertex(x) && !input->mesh->isMade(x); };
  if (isDouble(u) && isDouble(v) && isDouble(w)) {
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    const Point &a = input->point(u), &b = input->point(v), &c = input->point(w);
    return predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]});
  }
  const Point r = reference(u);
  return predicates.sign([&](auto number) {
    using Number = decltype(number);
    const auto a = point<Number>(u, r, predicates), b = point<Number>(v, r, predicates), c = point<Number>(w, r, predicates);
    return orientation(a, b, c, axis);
  });
}

CutVertices::Range CutVertices::range(VertexId v, int axis, Predicates& predicates) const {
  if (isTriVertex(v)) {
    const Bounded x =
        input->mesh->isMade(v) ? input->mesh->arrangement->points.approximate(v.number, axis) : Bounded(input->point(v)[axis]);
    if (x.error == 0) return {x.value, x.value};
    return {x.value - 2 * x.error, x.value + 2 * x.error};
  }
  const auto& planes = input->planes[axis];
  const int32_t c = slab(v)[axis] >> 1;
  if (onPlane(slab(v)[axis])) return {planes[c], planes[c]};
  const Point r = reference(v);
  const auto h = point<Bounded>(v, r, predicates);
  if (!(h.w.value > 2 * h.w.error)) return {planes[c], planes[c + 1]};
  const double x = r[axis] + h.x[axis].value / h.w.value;
  const double error = 2 * (h.x[axis].error + std::fabs(h.x[axis].value / h.w.value) * h.w.error) / h.w.value +
                       8 * kRoundoff * (std::fabs(r[axis]) + std::fabs(x));
  return {x - error, x + error};
}

void CutVertices::placeExactly(VertexId v, Point& p, Predicates& predicates) const {
  const Point r = reference(v);
  const auto h = point<Bounded>(v, r, predicates);
  for (size_t d = 0; d < 3; ++d) {
    if (onPlane(slab(v)[d])) continue;
    const double quotient = h.x[d].value / h.w.value;
    const double error = (h.x[d].error + std::fabs(quotient) * h.w.error) / (h.w.value - h.w.error);
    p[d] = r[d] + quotient;
    if (h.w.value > 2 * h.w.error && !(error > 8 * kRoundoff * std::max(std::fabs(r[d]), std::fabs(p[d])))) continue;
    if (isImplicit(v)) {  // it would show
      const auto exact = point<Big>(v, {0, 0, 0}, predicates);
      p[d] = Big::quotient(exact.x[d], exact.w);
    } else {
      const auto exact = point<Expansion>(v, r, predicates);
      p[d] = r[d] + Expansion::quotient(exact.x[d], exact.w);
    }
  }
}

/// A number beside a plane, toward another one. Next to 0, one that is still a number besides 0 in the user's units, and read again.
static double beside(double plane, double toward) {
  if (plane != 0) return std::nextafter(plane, toward);
  return std::copysign(std::min(Scale::kFlushBelow, std::fabs(toward) / 2), toward);
}

Point CutVertices::position(VertexId v, Predicates& predicates, bool onlyGeneral) const {
  if (isTriVertex(v) && !input->mesh->isMade(v)) return input->point(v);
  const Slab& of = slab(v);
  Point p, low, high;  // the planes around it
  for (size_t d = 0; d < 3; ++d) {
    const double* planes = &input->planes[d][size_t(std::max(of[d] >> 1, 0))];
    p[d] = low[d] = planes[0];
    high[d] = planes[of[d] & 1];
  }
  if (planeCount(of) == 3) return p;
  if (onlyGeneral || !placeQuickly(*this, v, p)) placeExactly(v, p, predicates);
  for (size_t d = 0; d < 3; ++d) {
    // Strictly inside of the slab, so that vertices on different grid elements have different positions.
    const bool isInside = int(p[d] > low[d]) & int(p[d] < high[d]);
    if (int(isInside) | int(onPlane(of[d]))) continue;
    p[d] = p[d] <= low[d] ? std::min(beside(low[d], high[d]), high[d]) : std::max(beside(high[d], low[d]), low[d]);
  }
  return p;
}

std::optional<TriEdgeId> CutVertices::triEdgeOf(const Link& link) const {
  for (size_t i = 0; i < 2; ++i) {
    if (!isOnEdge(link[i])) continue;
    const TriEdgeId edge = triEdge(link[i]);
    const VertexId other = link[1 - i];
    const auto& ends = edges->ends[edge];
    if (other == ends[0] || other == ends[1] || (isOnEdge(other) && triEdge(other) == edge)) return edge;
  }
  if (!isTriVertex(link[0]) || !isTriVertex(link[1])) return {};
  const auto at = std::lower_bound(edges->ends.begin(), edges->ends.end(), link);
  if (at == edges->ends.end() || *at != link) return {};
  return TriEdgeId{uint32_t(at - edges->ends.begin())};
}

bool CutVertices::runsUp(TriEdgeId edge, const Link& link) const {
  const auto rank = [&](VertexId v) -> uint64_t {  // crossings come in order from the lower end
    return v == edges->ends[edge][0] ? 0 : v == edges->ends[edge][1] ? ~uint64_t(0) : uint64_t(v.number) + 1;
  };
  return rank(link[0]) < rank(link[1]);
}

std::optional<TriangleId> CutVertices::triangleAt(VertexId v) const {
  if (isInTriangle(v)) return triangle(v);
  if (!isTriVertex(v) && !isOnEdge(v)) return {};
  const auto [low, high] = isTriVertex(v) ? std::array<VertexId, 2>{v, v} : edges->ends[triEdge(v)];
  for (const TriangleId t : input->triangleIds()) {
    const auto c = input->verticesOf(t);
    if (input->kept(t) && std::count(c.begin(), c.end(), low) && std::count(c.begin(), c.end(), high)) return t;
  }
  for (const TriangleId t : input->triangleIds()) {  // an edge that only stitching made
    const auto c = input->verticesOf(t);
    if (std::count(c.begin(), c.end(), low)) return t;
  }
  return {};
}

void CutVertices::failSelfIntersection(std::optional<TriangleId> triangle, std::optional<TriangleId> other) const {
  const auto element = [](const std::optional<TriangleId>& t) { return t ? int64_t(t->number) : -1; };
  throw Failure{{Status::selfIntersection, element(triangle), element(other), {}}};
}

}  // namespace mandoline::detail
