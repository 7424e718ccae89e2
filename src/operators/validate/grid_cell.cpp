#include "operators/validate/grid_cell.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::validation {

void VertexNumbers::clear() {
  vertices_.clear();
  slots_.assign(64, kFree);
}

uint32_t VertexNumbers::add(uint32_t vertex) {
  const size_t slot = slotOf(vertex);
  if (slots_[slot] != kFree) return slots_[slot];
  const uint32_t number = uint32_t(vertices_.size());
  slots_[slot] = number;
  vertices_.push_back(vertex);
  if (2 * vertices_.size() > slots_.size()) {
    slots_.assign(2 * slots_.size(), kFree);
    for (uint32_t i = 0; i < vertices_.size(); ++i) slots_[slotOf(vertices_[i])] = i;
  }
  return number;
}

uint32_t GridCell::addVertex(uint32_t v) {
  const uint32_t number = numbers.add(v);
  if (number == places.size()) places.push_back(local(context.vertex(v)));
  return number;
}

void GridCell::gather(size_t group) {
  faces.clear(), cornerVertex.clear(), cornerNext.clear(), corners.clear(), listings_.clear(), numbers.clear(), places.clear();
  cells = context.groups[group];
  for (int d = 0; d < 3; ++d) {
    const std::vector<double>& planes = context.planes()[size_t(d)];
    index[size_t(d)] = context.gridCellOf(cells[0])[d];
    low[d] = planes[size_t(index[size_t(d)])];
    size[d] = planes[size_t(index[size_t(d)]) + 1] - low[d];
    noise[d] = std::max(context.rounding[d] / size[d], kRounding);
  }
  for (const uint32_t c : cells) {
    for (const uint32_t h : context.cut.halfFaces(c)) listings_.push_back({h, int32_t(c)});
  }
  detail::sortItems(
      listings_, [](const Listing& a, const Listing& b) { return a.halfFace != b.halfFace ? a.halfFace < b.halfFace : a.cell < b.cell; });
  for (const Listing& listing : listings_) {
    const uint32_t id = listing.halfFace / 2;
    if (faces.empty() || faces.back().id != id) addFace(id);
    int32_t& owner = faces.back().owner[listing.halfFace % 2];
    if (owner < 0) owner = listing.cell;
  }
  for (const Edge& edge : context.edgesBeyond[group]) addVertex(edge[0]), addVertex(edge[1]);
  faceTree.build(faces.size(), [&](size_t f) { return detail::BoxTree::Item{boxOf(faces[f].low, faces[f].high), uint32_t(f)}; });
}

void GridCell::addFace(uint32_t id) {
  const uint32_t firstCorner = uint32_t(corners.size());
  const Vec3 infinite{{INFINITY, INFINITY, INFINITY}};
  faces.push_back({id, {-1, -1}, firstCorner, firstCorner, -1, infinite, -1 * infinite, 0, 0, {}, {}});
  Face& face = faces.back();
  const int axis = context.cut.faceAxis[id];
  if (axis >= 0) face.side = 2 * axis + (context.cut.facePlane[id] == index[size_t(axis)] ? 0 : 1);
  for (const std::span<const uint32_t> loop : context.cut.loops(id)) addLoop(face, loop);
  face.lastCorner = uint32_t(corners.size());
}

void GridCell::addLoop(Face& face, std::span<const uint32_t> loop) {
  const size_t first = corners.size();
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3 q = places[addVertex(loop[i])];
    for (int d = 0; d < 3; ++d) face.low[d] = std::min(face.low[d], q[d]), face.high[d] = std::max(face.high[d], q[d]);
    corners.push_back(q);
    cornerVertex.push_back(loop[i]);
    cornerNext.push_back(uint32_t(i + 1 < loop.size() ? first + i + 1 : first));
  }
  // A fan from the loop's first corner.
  for (size_t i = first; i < corners.size(); ++i) {
    const Vec3 &a = corners[first], &b = corners[i], &c = corners[cornerNext[i]];
    const Vec3 ab = b - a, ac = c - a, twice = cross(ab, ac);
    face.area = face.area + 0.5 * twice;
    face.volume += dot(a, twice) / 6;
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3, f = (d + 2) % 3;
      const double areaNoise = noise[e] * std::fabs(c[f] - b[f]) + noise[f] * std::fabs(c[e] - b[e]) + noise[e] * noise[f];
      face.areaNoise[d] += areaNoise;
      // The second term is what computing it loses, which is more where the triangle is long and thin.
      face.volumeNoise += noise[d] * (std::fabs(twice[d]) / 2 + areaNoise) +
                          kRounding * std::fabs(a[d]) * (std::fabs(ab[e] * ac[f]) + std::fabs(ab[f] * ac[e]));
    }
  }
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

}  // namespace mandoline::validation
