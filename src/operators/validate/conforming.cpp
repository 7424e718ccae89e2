// No vertex lies inside an edge of the same grid cell. Positions find the candidates; the exact places decide.
#include <algorithm>

#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {

void ConformingCheck::gatherVertices(const GridCell& cell) {
  const std::vector<uint32_t>& ids = cell.numbers.vertices();
  vertices_.build(ids.size(), [&](size_t i) { return detail::BoxTree::Item{boxOf(cell.places[i], cell.places[i]), ids[i]}; });
}

void ConformingCheck::run(const GridCell& cell, const std::vector<Edge>& edges, CellSpots& spots) {
  gatherVertices(cell);
  for (const Edge& edge : edges) {
    const Vec3 &a = cell.placeOf(edge[0]), &b = cell.placeOf(edge[1]);
    Vec3 low, high;
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(a[d], b[d]) - kTolerance * cell.noise[d], high[d] = std::max(a[d], b[d]) + kTolerance * cell.noise[d];
    }
    vertices_.forOverlapping(boxOf(low, high), [&](uint32_t v) {
      if (v != edge[0] && v != edge[1]) checkVertex(cell, edge, v, spots);
    });
  }
}

void ConformingCheck::checkVertex(const GridCell& cell, const Edge& edge, uint32_t vertex, CellSpots& spots) {
  const Context& x = cell.context;
  const auto sharePlane = [&](uint32_t u, uint32_t v, int d) {
    return x.onPlane(u, d) && x.onPlane(v, d) && x.cellAt(u)[d] == x.cellAt(v)[d];
  };
  for (int d = 0; d < 3; ++d) {
    if (sharePlane(edge[0], edge[1], d) && !sharePlane(edge[0], vertex, d)) return;
  }
  const Vec3 from = x.vertex(edge[0]), p = x.vertex(vertex), a = x.inRoundings(from, p), b = x.inRoundings(x.vertex(edge[1]), p);
  if (distanceToSegment({}, a, b) > kTolerance || !collinear(x.exact[edge[0]], x.exact[edge[1]], x.exact[vertex])) return;
  const int axis = dominantAxis(b - a);
  const double low = std::min(a[axis], b[axis]), high = std::max(a[axis], b[axis]);
  if (high < -kTolerance || low > kTolerance) return;
  const bool certain = low < -kTolerance && high > kTolerance;
  if (certain || isBetween(cell, edge, vertex, spots)) conforming_.violate("vertex", vertex, "lies inside an edge of its grid cell");
}

/// Exact: whether a vertex on the line of an edge lies inside of that.
bool ConformingCheck::isBetween(const GridCell& cell, const Edge& edge, uint32_t vertex, CellSpots& spots) {
  const Context& x = cell.context;
  for (const uint32_t v : {edge[0], edge[1], vertex}) {
    if (!x.exact.isKnown(v)) return false;  // reported elsewhere
  }
  const Spot &from = spots.at(cell, edge[0]), &to = spots.at(cell, edge[1]), &point = spots.at(cell, vertex);
  for (int d = 0; d < 3; ++d) {
    if (compare(x, from, point, d) * compare(x, to, point, d) < 0) return true;
  }
  return false;
}

}  // namespace mandoline::validation
