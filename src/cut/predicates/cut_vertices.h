// The cut-vertices (paper, 3.2) and exact predicates on them.
//
// Ids are ranges: tri-vertices (by input id; where triangles meet, made vertices follow), crossings of tri-edges with axial planes,
// crossings of triangles with grid lines; and those that a brick makes of its own: more of the latter, and grid vertices. Every vertex has
// slabs; its coordinates are only ever known as quotients of polynomials in input and plane doubles.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "base/exact.h"
#include "cut/scaled_input.h"

namespace mandoline::detail {

struct CutVertices {
  static constexpr int32_t kUnused = INT32_MIN;      ///< slab(v)[0] of an id that no vertex has
  static constexpr Slab kNone{kUnused, 1, kUnused};  ///< slab(v) of it
  static constexpr TriangleId kNoTriangle{~0u};

  const Input* input = nullptr;
  const MeshEdges* edges = nullptr;
  const CutVertices* surface = nullptr;                      ///< those that all bricks have in common; null if these are they
  VertexId firstOnEdge{0}, firstInTriangle{0}, firstOwn{0};  ///< where the ranges begin
  std::vector<Slab> slabs;                                   ///< of those from firstOwn on
  std::vector<VertexId> crossingOffsets;    ///< per tri-edge: its crossings start here, from its lower end on; unused ids end them
  std::vector<TriEdgeId> parentEdges;       ///< of the vertices on edges
  std::vector<TriangleId> parentTriangles;  ///< of the vertices after them that are not the surface's; kNoTriangle of a grid vertex

  CutVertices() = default;
  /// Those of a brick that has none of its own yet.
  static CutVertices ofBrick(const CutVertices& surface);

  size_t size() const { return firstOwn.number + slabs.size(); }
  Ids<VertexId> ids() const { return Ids<VertexId>(size()); }
  Ids<VertexId> ownIds() const { return {firstOwn, VertexId{uint32_t(size())}}; }
  const Slab& slab(VertexId v) const { return v < firstOwn ? surface->slabs[v.number] : slabs[v.number - firstOwn.number]; }
  VertexId add(const Slab& slab, TriangleId triangle) {
    slabs.push_back(slab);
    parentTriangles.push_back(triangle);
    return {uint32_t(size() - 1)};
  }

  bool isUsed(VertexId v) const { return slab(v)[0] != kUnused; }
  bool isTriVertex(VertexId v) const { return v < firstOnEdge; }
  bool isOnEdge(VertexId v) const { return v >= firstOnEdge && v < firstInTriangle; }
  bool isInTriangle(VertexId v) const { return v >= firstInTriangle && triangle(v) != kNoTriangle; }
  /// The crossings of a tri-edge, then unused ids.
  Ids<VertexId> crossings(TriEdgeId edge) const {
    const std::vector<VertexId>& offsets = ofSurface().crossingOffsets;
    return {offsets[edge.number], offsets[edge.number + 1]};
  }
  /// Of a vertex on an edge.
  TriEdgeId triEdge(VertexId v) const { return ofSurface().parentEdges[v.number - firstOnEdge.number]; }
  /// Of a vertex from firstInTriangle on.
  TriangleId triangle(VertexId v) const {
    return v < firstOwn ? surface->triangle(v) : parentTriangles[v.number - std::max(firstInTriangle, firstOwn).number];
  }

  /// Whether its exact coordinates are polynomials of a higher degree than Expansion is for.
  bool isImplicit(VertexId v) const { return isTriVertex(v) ? input->mesh->isMade(v) : isOnEdge(v) && edges->line(triEdge(v)).ofPlanes; }

  using Link = std::array<VertexId, 2>;  ///< two vertices next to each other, the lower one first
  /// The tri-edge that a link is a piece of, if any.
  std::optional<TriEdgeId> triEdgeOf(const Link& link) const;
  /// Whether a piece of a tri-edge runs along it from its lower end.
  bool runsUp(TriEdgeId edge, const Link& link) const;

  /// A double point at or near the vertex, for coordinates relative to it.
  Point reference(VertexId v) const;
  template <class Number>
  Homogeneous<Number> point(VertexId v, const Point& reference, Predicates& predicates) const;

  /// P3: order of two vertices along an axis; also the order along a grid line.
  int compare(VertexId u, VertexId v, int axis, Predicates& predicates) const;
  /// P4, P5: whether u, v, w turn counter-clockwise (1) about +axis, seen along it.
  int orient(VertexId u, VertexId v, VertexId w, int axis, Predicates& predicates) const;

  /// Bounds of a coordinate, proven.
  struct Range {
    double low, high;
  };
  Range range(VertexId v, int axis, Predicates& predicates) const;
  /// The coordinates as doubles, rounded but within the vertex's slabs. `onlyGeneral`: without the quick ways, which give the same.
  Point position(VertexId v, Predicates& predicates, bool onlyGeneral = false) const;

  /// Some triangle that the vertex lies on, to blame.
  std::optional<TriangleId> triangleAt(VertexId v) const;
  /// Ends the cut because two vertices or edges meet although the input promised that none do. The triangles that it blames, if any, may be
  /// the wrong ones: explainContradiction() finds out.
  [[noreturn]] void failSelfIntersection(std::optional<TriangleId> triangle, std::optional<TriangleId> other) const;
  [[noreturn]] void failSelfIntersectionAt(VertexId u, VertexId v) const { failSelfIntersection(triangleAt(u), triangleAt(v)); }

 private:
  const CutVertices& ofSurface() const { return surface ? *surface : *this; }
  template <class Number>
  Homogeneous<Number> pointOfPlanes(VertexId v, const Line& line, const Point& reference) const;
  void placeExactly(VertexId v, Point& p, Predicates& predicates) const;
};

/// A crossing of the line that two triangles' planes have in common.
template <class Number>
Homogeneous<Number> CutVertices::pointOfPlanes(VertexId v, const Line& line, const Point& reference) const {
  const VertexId low = edges->ends[triEdge(v)][0], high = edges->ends[triEdge(v)][1];
  int across = -1;  // an axis whose plane crosses the edge, at the widest angle so far as is known
  const auto extent = [&](int d) { return std::fabs(input->point(high)[size_t(d)] - input->point(low)[size_t(d)]); };
  for (int d = 0; d < 3; ++d) {
    const bool crosses = onPlane(slab(v)[size_t(d)]) && slab(low)[size_t(d)] != slab(high)[size_t(d)];
    if (crosses && (across < 0 || extent(d) > extent(across))) across = d;
  }
  const auto toPlane = [&](int d) {
    return Number::difference(input->planes[size_t(d)][size_t(slab(v)[size_t(d)] >> 1)], reference[size_t(d)]);
  };
  const Plane<Number> plane{{{Number(across == 0), Number(across == 1), Number(across == 2)}}, toPlane(across)};
  Homogeneous<Number> h =
      meetingPoint(planeOf<Number>(*input->mesh, line.a, reference), planeOf<Number>(*input->mesh, line.b, reference), plane);
  if constexpr (std::is_same_v<Number, Bounded>) {  // keeps later products small
    for (Number& x : h.x) x = quotient(x, h.w);
    h.w = Number(1);
  } else if (h.w.sign() < 0) {
    for (Number& x : h.x) x = -x;
    h.w = -h.w;
  }
  for (int d = 0; d < 3; ++d) {
    if (onPlane(slab(v)[size_t(d)])) h.x[d] = toPlane(d) * h.w;
  }
  return h;
}

template <class Number>
Homogeneous<Number> CutVertices::point(VertexId v, const Point& reference, Predicates& predicates) const {
  const auto diff = &Number::difference;
  const auto planeOf = [&](int d) { return input->planes[d][slab(v)[d] >> 1]; };
  Homogeneous<Number> h;
  h.w = Number(1);
  if (isTriVertex(v)) {
    if constexpr (!std::is_same_v<Number, Expansion>) {
      if (input->mesh->isMade(v)) return input->mesh->arrangement->points.point<Number>(v.number, reference);
    }
    for (int d = 0; d < 3; ++d) h.x[d] = diff(input->point(v)[d], reference[d]);
  } else if (planeCount(slab(v)) == 3) {
    for (int d = 0; d < 3; ++d) h.x[d] = diff(planeOf(d), reference[d]);
  } else if (isOnEdge(v)) {
    const Line along = edges->line(triEdge(v));
    if constexpr (!std::is_same_v<Number, Expansion>) {
      if (along.ofPlanes) return pointOfPlanes<Number>(v, along, reference);
    }
    VertexId low{along.a}, high{along.b};
    int across = -1;  // the axis whose plane cuts the edge at the widest angle
    for (int d = 0; d < 3; ++d) {
      const auto extent = [&](int e) { return std::fabs(input->point(high)[e] - input->point(low)[e]); };
      if (onPlane(slab(v)[d]) && (across < 0 || extent(d) > extent(across))) across = d;
    }
    if (input->point(low)[across] > input->point(high)[across]) std::swap(low, high);
    const Point &a = input->point(low), &b = input->point(high);
    h.w = diff(b[across], a[across]);
    const Number way = diff(planeOf(across), a[across]);
    for (int d = 0; d < 3; ++d) {
      h.x[d] = onPlane(slab(v)[d]) ? diff(planeOf(d), reference[d]) * h.w : diff(a[d], reference[d]) * h.w + way * diff(b[d], a[d]);
    }
  } else {
    const auto t = input->verticesOf(triangle(v));
    const Point &a = input->point(t[0]), &b = input->point(t[1]), &c = input->point(t[2]);
    const int g = !onPlane(slab(v)[0]) ? 0 : !onPlane(slab(v)[1]) ? 1 : 2, e = (g + 1) % 3, f = (g + 2) % 3;  // the grid line runs along g
    const auto normal = [&](int p, int q) { return diff(b[p], a[p]) * diff(c[q], a[q]) - diff(b[q], a[q]) * diff(c[p], a[p]); };
    const bool flip = predicates.orient2d({a[e], a[f]}, {b[e], b[f]}, {c[e], c[f]}) < 0;
    const Number ng = flip ? -normal(e, f) : normal(e, f), ne = flip ? -normal(f, g) : normal(f, g),
                 nf = flip ? -normal(g, e) : normal(g, e);
    h.w = ng;
    h.x[e] = diff(planeOf(e), reference[e]) * ng;
    h.x[f] = diff(planeOf(f), reference[f]) * ng;
    h.x[g] = diff(a[g], reference[g]) * ng - (ne * diff(planeOf(e), a[e]) + nf * diff(planeOf(f), a[f]));
  }
  return h;
}

}  // namespace mandoline::detail
