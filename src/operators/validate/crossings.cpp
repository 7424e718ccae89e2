// Where triangles intersect inside a grid cell, the cut-mesh may be fine combinatorially; but then an edge of one face crosses another.
#include <algorithm>

#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {

void CrossingCheck::run(const GridCell& cell, const std::vector<Edge>& edges) {
  Vec3 area;
  for (const GridCell::Face& face : cell.faces) {
    for (int d = 0; d < 3 && face.side < 0; ++d) area[d] += std::fabs(face.area[d]);
  }
  bins_.build(cell, dominantAxis(area));  // most faces are seen from the front
  for (const Edge& edge : edges) {
    const Vec3 a = cell.local(cell.context.vertex(edge[0])), b = cell.local(cell.context.vertex(edge[1]));
    Vec3 low, high;
    for (int d = 0; d < 3; ++d) low[d] = std::min(a[d], b[d]), high[d] = std::max(a[d], b[d]);
    bins_.forFaces(low, high, [&](uint32_t f) {
      const GridCell::Face& face = cell.faces[f];
      bool apart = face.side >= 0;
      for (int d = 0; d < 3; ++d) apart |= low[d] >= face.high[d] || high[d] <= face.low[d];
      if (!apart) checkEdge(cell, a, b, f);
    });
  }
}

void CrossingCheck::checkEdge(const GridCell& cell, const Vec3& from, const Vec3& to, uint32_t f) {
  const GridCell::Face& face = cell.faces[f];
  Normal normal = cell.context.triangleNormal(size_t(cell.context.cut.faceTriangle[face.id]));
  double doubt = 0;  // of heights over the face's plane
  for (int d = 0; d < 3; ++d) {
    normal.n[d] *= cell.size[d], normal.error[d] *= cell.size[d];
    doubt += normal.error[d] + kTolerance * cell.noise[d] * std::fabs(normal.n[d]);
  }
  const Vec3& origin = cell.corners[face.firstCorner];
  const double h = dot(from - origin, normal.n), k = dot(to - origin, normal.n);
  if (!(std::min(h, k) < -doubt && std::max(h, k) > doubt)) return;
  const Vec3 along = to - from, point = from + h / (h - k) * along;
  Vec3 margin;
  for (int d = 0; d < 3; ++d) margin[d] = kTolerance * cell.noise[d] + 2 * doubt / std::fabs(h - k) * std::fabs(along[d]);
  if (placeOn(cell, face, dominantAxis(normal.n), point, margin) == Place::inside)
    crossings_.violate("face", face.id, "is crossed by an edge");
}

}  // namespace mandoline::validation
