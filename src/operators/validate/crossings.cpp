// Where triangles intersect inside of a grid cell, the cut-mesh may be fine combinatorially; but then an edge of one face crosses another.
#include <algorithm>

#include "operators/validate/grid_cells.h"

namespace mandoline::validation {

void FaceBins::build(const GridCell& cell, int axis) {
  axis_ = axis;
  const int d = (axis + 1) % 3, e = (axis + 2) % 3;
  bins_ = std::clamp(int(std::sqrt(double(cell.faces.size()) / 8)), 1, 256);
  offsets_.assign(size_t(bins_) * bins_ + 2, 0);  // counted two places on, so that filling leaves begins one place on
  const auto forBins = [&](const GridCell::Face& face, auto&& use) {
    if (face.side >= 0 && face.side / 2 != axis) return;
    const double md = kTolerance * cell.noise[d], me = kTolerance * cell.noise[e];
    for (size_t j = binOf(face.low[e] - me); j <= binOf(face.high[e] + me); ++j) {
      for (size_t i = binOf(face.low[d] - md); i <= binOf(face.high[d] + md); ++i) use(j * size_t(bins_) + i);
    }
  };
  for (const GridCell::Face& face : cell.faces) forBins(face, [&](size_t b) { ++offsets_[b + 2]; });
  for (size_t b = 2; b < offsets_.size(); ++b) offsets_[b] += offsets_[b - 1];
  faces_.resize(offsets_.back());
  for (uint32_t i = 0; i < cell.faces.size(); ++i) forBins(cell.faces[i], [&](size_t b) { faces_[offsets_[b + 1]++] = i; });
}

Place placeOn(const GridCell& cell, const GridCell::Face& face, int axis, const Vec3& point, const Vec3& margin) {
  const int d = (axis + 1) % 3, e = (axis + 2) % 3;
  const double pd = point[d], pe = point[e], md = margin[d], me = margin[e];
  bool inside = false;
  for (uint32_t i = face.firstCorner; i < face.lastCorner; ++i) {
    const Vec3 &a = cell.corners[i], &b = cell.corners[cell.cornerNext[i]];
    if ((a[e] < pe - me && b[e] < pe - me) || (a[e] > pe + me && b[e] > pe + me) || (a[d] < pd - md && b[d] < pd - md)) continue;
    const double alongD = b[d] - a[d], alongE = b[e] - a[e], left = alongD * (pe - a[e]) - alongE * (pd - a[d]);
    const double doubt = me * (std::fabs(alongD) + std::fabs(pd - a[d])) + md * (std::fabs(alongE) + std::fabs(pe - a[e]));
    const bool ahead = pd < std::min(a[d], b[d]) - md;
    if (!ahead && std::fabs(left) <= doubt) return Place::open;
    if ((a[e] > pe) != (b[e] > pe) && (ahead || (alongE > 0) == (left > 0))) inside = !inside;
  }
  return inside ? Place::inside : Place::outside;
}

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
