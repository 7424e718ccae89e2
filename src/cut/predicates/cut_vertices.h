// The cut-vertices (paper, 3.2) and exact predicates on them.
//
// Ids are ranges: tri-vertices (by input id), crossings of tri-edges with axial planes, crossings of triangles with grid lines, grid
// vertices. Every vertex has slabs; its coordinates are only ever known as quotients of polynomials in input and plane doubles.
#pragma once

#include <vector>

#include "base/exact.h"
#include "cut/scaled_input.h"

namespace mandoline::detail {

/// A vertex in homogeneous coordinates (x / w, y / w, z / w) relative to some double point; w > 0.
template <class Number>
struct Homogeneous {
  Number x[3];
  Number w;
};

struct CutVertices {
  static constexpr int32_t kUnused = INT32_MIN;  ///< slabs[v][0] of an id that no vertex has

  const Input* input = nullptr;
  const std::vector<std::array<uint32_t, 2>>* triEdges = nullptr;  ///< ends, lower tri-vertex first
  uint32_t firstOnEdge = 0, firstInTriangle = 0, firstOnGrid = 0;  ///< where the ranges begin
  std::vector<Slab> slabs;
  std::vector<uint32_t> parents;  ///< of ids firstOnEdge and up: tri-edge, then triangle; none for grid vertices

  size_t size() const { return slabs.size(); }
  bool isTriVertex(uint32_t v) const { return v < firstOnEdge; }
  bool isOnEdge(uint32_t v) const { return v >= firstOnEdge && v < firstInTriangle; }
  bool isInTriangle(uint32_t v) const { return v >= firstInTriangle && v < firstOnGrid; }
  /// Of a vertex on an edge.
  uint32_t triEdge(uint32_t v) const { return parents[v - firstOnEdge]; }
  /// Of a vertex in a triangle.
  uint32_t triangle(uint32_t v) const { return parents[v - firstOnEdge]; }

  /// Adds vertices at the end of the last range.
  void append(const Slab& slab) { slabs.push_back(slab); }

  /// A double point at or near the vertex, for coordinates relative to it.
  Point reference(uint32_t v) const;
  template <class Number>
  Homogeneous<Number> point(uint32_t v, const Point& reference, Predicates& predicates) const;

  /// P3: order of two vertices along an axis; also the order along a grid line.
  int compare(uint32_t u, uint32_t v, int axis, Predicates& predicates) const;
  /// P4, P5: whether u, v, w turn counter-clockwise (1) about +axis, seen along it.
  int orient(uint32_t u, uint32_t v, uint32_t w, int axis, Predicates& predicates) const;

  /// Bounds of a coordinate, proven.
  struct Range {
    double low, high;
  };
  Range range(uint32_t v, int axis, Predicates& predicates) const;
  /// The coordinates as doubles, rounded but within the vertex's slabs.
  Point position(uint32_t v, Predicates& predicates) const;

  /// Some triangle that the vertex lies on, to blame.
  int64_t triangleAt(uint32_t v) const;
  /// Ends the cut because two vertices or edges meet where the input promised that they do not, blaming triangles (or -1) that may be the
  /// wrong ones: explainContradiction() finds out.
  [[noreturn]] void failSelfIntersection(int64_t triangle, int64_t other) const;
  [[noreturn]] void failSelfIntersectionAt(uint32_t u, uint32_t v) const { failSelfIntersection(triangleAt(u), triangleAt(v)); }
};

template <class Number>
Homogeneous<Number> CutVertices::point(uint32_t v, const Point& reference, Predicates& predicates) const {
  const auto diff = &Number::difference;
  const auto planeOf = [&](int d) { return input->planes[d][slabs[v][d] >> 1]; };
  Homogeneous<Number> h;
  h.w = Number(1);
  if (isTriVertex(v)) {
    for (int d = 0; d < 3; ++d) h.x[d] = diff(input->points[v][d], reference[d]);
  } else if (planeCount(slabs[v]) == 3) {
    for (int d = 0; d < 3; ++d) h.x[d] = diff(planeOf(d), reference[d]);
  } else if (isOnEdge(v)) {
    uint32_t low = (*triEdges)[triEdge(v)][0], high = (*triEdges)[triEdge(v)][1];
    int across = -1;  // the axis whose plane cuts the edge at the widest angle
    for (int d = 0; d < 3; ++d) {
      const auto extent = [&](int e) { return std::fabs(input->points[high][e] - input->points[low][e]); };
      if (onPlane(slabs[v][d]) && (across < 0 || extent(d) > extent(across))) across = d;
    }
    if (input->points[low][across] > input->points[high][across]) std::swap(low, high);
    const Point &a = input->points[low], &b = input->points[high];
    h.w = diff(b[across], a[across]);
    const Number along = diff(planeOf(across), a[across]);
    for (int d = 0; d < 3; ++d) {
      h.x[d] = onPlane(slabs[v][d]) ? diff(planeOf(d), reference[d]) * h.w : diff(a[d], reference[d]) * h.w + along * diff(b[d], a[d]);
    }
  } else {
    const auto& t = input->triangles[triangle(v)];
    const Point &a = input->points[t[0]], &b = input->points[t[1]], &c = input->points[t[2]];
    const int g = !onPlane(slabs[v][0])   ? 0
                  : !onPlane(slabs[v][1]) ? 1
                                          : 2,
              e = (g + 1) % 3, f = (g + 2) % 3;  // the grid line runs along g
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
