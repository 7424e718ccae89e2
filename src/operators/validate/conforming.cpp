// No vertex lies inside an edge of the same grid cell. Positions find the candidates; the vertices' parents and planes decide exactly.
#include <algorithm>

#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {
namespace {

/// A vertex as the exact quotients x / w.
struct ExactPoint {
  Exact x[3], w;
};

double planeOf(const Context& context, uint32_t v, int axis) { return context.planes()[size_t(axis)][size_t(context.cellAt(v)[axis])]; }

/// Where a tri-edge meets a plane that the vertex lies on.
void placeOnEdge(const Context& context, uint32_t v, const Vec3& a, const Vec3& b, ExactPoint& p) {
  int across = 0;
  while (across < 2 && (!context.onPlane(v, across) || a[across] == b[across])) ++across;
  const double plane = planeOf(context, v, across);
  const Exact toPlane = Exact(plane) - a[across], toEnd = Exact(b[across]) - plane;
  for (int d = 0; d < 3; ++d) p.x[d] = toEnd * a[d] + toPlane * b[d];
  p.w = toEnd + toPlane;
}

/// Where a triangle meets the grid line that the vertex lies on.
void placeInTriangle(const Context& context, uint32_t v, size_t triangle, ExactPoint& p) {
  int g = 0;  // the grid line's axis
  while (g < 2 && context.onPlane(v, g)) ++g;
  const int e = (g + 1) % 3, f = (g + 2) % 3;
  const Vec3 a = context.corner(triangle, 0), b = context.corner(triangle, 1), c = context.corner(triangle, 2);
  const auto normal = [&](int i, int j) {
    return (Exact(b[i]) - a[i]) * (Exact(c[j]) - a[j]) - (Exact(b[j]) - a[j]) * (Exact(c[i]) - a[i]);
  };
  const double pe = planeOf(context, v, e), pf = planeOf(context, v, f);
  p.w = normal(e, f);
  p.x[g] = p.w * a[g] - normal(f, g) * (Exact(pe) - a[e]) - normal(g, e) * (Exact(pf) - a[f]);
  p.x[e] = p.w * pe, p.x[f] = p.w * pf;
}

ExactPoint exactPoint(const Context& context, uint32_t v) {
  const CutMesh& cut = context.cut;
  ExactPoint p;
  p.w = 1;
  if (cut.vertexTriVertex[v] >= 0) {
    for (int d = 0; d < 3; ++d) p.x[d] = context.triVertex(uint32_t(cut.vertexTriVertex[v]))[d];
    return p;
  }
  for (int d = 0; d < 3; ++d) {
    if (context.onPlane(v, d)) p.x[d] = planeOf(context, v, d);
  }
  const int32_t parent = cut.vertexParents[2 * size_t(v)], other = cut.vertexParents[2 * size_t(v) + 1];
  if (cut.vertexMask[v] == 7 || parent < 0) return p;
  if (other >= 0) {
    placeOnEdge(context, v, context.triVertex(uint32_t(parent)), context.triVertex(uint32_t(other)), p);
  } else {
    placeInTriangle(context, v, size_t(parent), p);
  }
  return p;
}

/// Whether w lies on the open segment from u to v.
bool liesInside(const Context& context, uint32_t u, uint32_t v, uint32_t w) {
  const ExactPoint a = exactPoint(context, u), b = exactPoint(context, v), c = exactPoint(context, w);
  bool inside = false;
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    const Exact determinant =
        a.w * (b.x[e] * c.x[f] - b.x[f] * c.x[e]) - b.w * (a.x[e] * c.x[f] - a.x[f] * c.x[e]) + c.w * (a.x[e] * b.x[f] - a.x[f] * b.x[e]);
    if (determinant.sign() != 0) return false;
    const auto order = [d](const ExactPoint& p, const ExactPoint& q) {
      return (q.x[d] * p.w - p.x[d] * q.w).sign() * p.w.sign() * q.w.sign();
    };
    inside |= order(a, c) * order(c, b) > 0;
  }
  return inside;
}

}  // namespace

void ConformingCheck::gatherVertices(const GridCell& cell, const std::vector<Edge>& edges) {
  ids_.clear();
  for (const Edge& edge : edges) ids_.insert(ids_.end(), edge.begin(), edge.end());
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  for (int axis = 0; axis < 3; ++axis) {
    sorted_[axis].clear();
    for (const uint32_t v : ids_) sorted_[axis].push_back({v, cell.local(cell.context.vertex(v))});
    std::sort(sorted_[axis].begin(), sorted_[axis].end(),
              [&](const Vertex& a, const Vertex& b) { return a.position[axis] < b.position[axis]; });
  }
}

void ConformingCheck::run(const GridCell& cell, const std::vector<Edge>& edges) {
  gatherVertices(cell, edges);
  for (const Edge& edge : edges) {
    const Vec3 a = cell.local(cell.context.vertex(edge[0])), b = cell.local(cell.context.vertex(edge[1]));
    Vec3 low, high;
    const Vertex *first = nullptr, *last = nullptr;  // in the edge's box along the axis that leaves the fewest
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(a[d], b[d]) - kTolerance * cell.noise[d], high[d] = std::max(a[d], b[d]) + kTolerance * cell.noise[d];
      const auto begin = sorted_[d].data(), end = begin + sorted_[d].size();
      const auto from = std::lower_bound(begin, end, low[d], [&](const Vertex& v, double x) { return v.position[d] < x; });
      const auto to = std::upper_bound(from, end, high[d], [&](double x, const Vertex& v) { return x < v.position[d]; });
      if (!first || to - from < last - first) first = from, last = to;
    }
    for (const Vertex* v = first; v != last; ++v) {
      bool inBox = v->id != edge[0] && v->id != edge[1];
      for (int d = 0; d < 3; ++d) inBox &= v->position[d] >= low[d] && v->position[d] <= high[d];
      if (inBox) checkVertex(cell, edge, v->id);
    }
  }
}

void ConformingCheck::checkVertex(const GridCell& cell, const Edge& edge, uint32_t vertex) {
  const Context& x = cell.context;
  const auto sharePlane = [&](uint32_t u, uint32_t v, int d) {
    return x.onPlane(u, d) && x.onPlane(v, d) && x.cellAt(u)[d] == x.cellAt(v)[d];
  };
  for (int d = 0; d < 3; ++d) {
    if (sharePlane(edge[0], edge[1], d) && !sharePlane(edge[0], vertex, d)) return;
  }
  const Vec3 p = x.vertex(vertex), a = x.inRoundings(x.vertex(edge[0]), p), b = x.inRoundings(x.vertex(edge[1]), p);
  if (distanceToSegment({}, a, b) <= kTolerance && liesInside(x, edge[0], edge[1], vertex))
    conforming_.violate("vertex", vertex, "lies inside an edge of its grid cell");
}

}  // namespace mandoline::validation
