#include "mesh/resolve/segments.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::detail {

int axisAlong(const MeshPoints& points, uint32_t u, uint32_t v, Predicates& predicates) {
  int widest = 0;
  const auto extent = [&](int d) { return std::fabs(points.approximate(u, d).value - points.approximate(v, d).value); };
  for (int d = 1; d < 3; ++d) {
    if (extent(d) > extent(widest)) widest = d;
  }
  for (int i = 0; i < 3; ++i) {
    if (points.compare(u, v, (widest + i) % 3, predicates) != 0) return (widest + i) % 3;
  }
  return widest;
}

SegmentCrosser::Extent SegmentCrosser::extentOf(uint32_t item, std::span<const uint32_t> points) const {
  Extent extent{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, item};
  for (const uint32_t v : points) {
    for (int d = 0; d < 3; ++d) {
      const Bounded x = points_.approximate(v, d);
      extent.low[size_t(d)] = std::min(extent.low[size_t(d)], std::nextafter(x.value - x.error, -INFINITY));
      extent.high[size_t(d)] = std::max(extent.high[size_t(d)], std::nextafter(x.value + x.error, INFINITY));
    }
  }
  return extent;
}

void SegmentCrosser::cross(uint32_t triangle, std::span<const uint32_t> segments, std::span<const uint32_t> isolated) {
  triangle_ = triangle;
  const auto& t = mesh_.triangles[triangle];
  for (axis_ = 0; axis_ < 2 && points_.orient(t[0], t[1], t[2], axis_, predicates) == 0;) ++axis_;
  extents_.clear();
  for (const uint32_t s : segments) extents_.push_back(extentOf(s, segments_[s].ends));
  for (const uint32_t& v : isolated) extents_.push_back(extentOf(~v, {&v, 1}));
  size_t sweep = 0;  // the axis along which the triangle is longest
  const Extent whole = extentOf(0, t);
  for (size_t d = 1; d < 3; ++d) {
    if (whole.high[d] - whole.low[d] > whole.high[sweep] - whole.low[sweep]) sweep = d;
  }
  sortItems(extents_,
            [&](const Extent& a, const Extent& b) { return a.low[sweep] != b.low[sweep] ? a.low[sweep] < b.low[sweep] : a.item < b.item; });
  const auto isPoint = [](const Extent& e) { return e.item >> 31 != 0; };
  for (size_t i = 0; i < extents_.size(); ++i) {
    for (size_t j = i + 1; j < extents_.size() && extents_[j].low[sweep] <= extents_[i].high[sweep]; ++j) {
      const Extent &a = extents_[i], &b = extents_[j];
      bool apart = false;
      for (size_t d = 0; d < 3; ++d) apart |= a.low[d] > b.high[d] || b.low[d] > a.high[d];
      if (apart || (isPoint(a) && isPoint(b))) continue;
      if (isPoint(a)) {
        touch(b.item, ~a.item);
      } else if (isPoint(b)) {
        touch(a.item, ~b.item);
      } else {
        crossPair(std::min(a.item, b.item), std::max(a.item, b.item));
      }
    }
  }
}

void SegmentCrosser::touch(uint32_t segment, uint32_t point) {
  if (sideOf(segment, point) == 0 && isBetween(segment, point)) touches.push_back({segment, point});
}

void SegmentCrosser::crossPair(uint32_t j, uint32_t k) {
  const Segment &a = segments_[j], &b = segments_[k];
  const int a0 = sideOf(k, a.ends[0]), a1 = sideOf(k, a.ends[1]);
  if (a0 * a1 > 0) return;
  if (a0 == 0 && a1 == 0) {  // on one line
    for (size_t i = 0; i < 2; ++i) {
      if (isBetween(k, a.ends[i])) touches.push_back({k, a.ends[i]});
      if (isBetween(j, b.ends[i])) touches.push_back({j, b.ends[i]});
    }
    return;
  }
  const int b0 = sideOf(j, b.ends[0]), b1 = sideOf(j, b.ends[1]);
  if (b0 * b1 > 0) return;
  if (a0 * a1 < 0 && b0 * b1 < 0) {
    crossings.push_back({{j, k}, keyOf(a.line, b.line)});
  } else if (a0 * a1 < 0) {
    touches.push_back({j, b.ends[b0 == 0 ? 0 : 1]});
  } else if (b0 * b1 < 0) {
    touches.push_back({k, a.ends[a0 == 0 ? 0 : 1]});
  }
}

/// The side of a segment's line that a point of the triangle lies on.
int SegmentCrosser::sideOf(uint32_t segment, uint32_t point) {
  const auto& [triangle, ends, inside, line] = segments_[segment];
  if (point == ends[0] || point == ends[1]) return 0;
  if (line.ofPlanes) return points_.sideOfPlane(line.a == triangle_ ? line.b : line.a, point, predicates);
  if (points_.isMade(point)) {
    const PointKey& key = points_.key(point);
    const auto isLine = [&, a = std::min(line.a, line.b), b = std::max(line.a, line.b)](size_t i) {
      return key.ids[i] == a && key.ids[i + 1] == b;
    };
    if (key.kind == PointKey::Kind::edgeTriangle && isLine(0)) return 0;
    if (key.kind == PointKey::Kind::edgeEdge && (isLine(0) || isLine(2))) return 0;
  }
  return points_.orient(line.a, line.b, point, axis_, predicates);
}

/// Whether a point of a segment's line lies strictly between its ends.
bool SegmentCrosser::isBetween(uint32_t segment, uint32_t point) {
  const auto& ends = segments_[segment].ends;
  if (point == ends[0] || point == ends[1]) return false;
  const int axis = axisAlong(points_, ends[0], ends[1], predicates);
  return points_.compare(ends[0], point, axis, predicates) * points_.compare(point, ends[1], axis, predicates) > 0;
}

/// The point where two lines in the triangle cross.
PointKey SegmentCrosser::keyOf(const Line& a, const Line& b) const {
  const auto other = [&](const Line& line) { return line.a == triangle_ ? line.b : line.a; };
  const auto edge = [](const Line& line) { return PointKey::Edge{std::min(line.a, line.b), std::max(line.a, line.b)}; };
  if (a.ofPlanes && b.ofPlanes) return PointKey::ofTriangles(triangle_, other(a), other(b));
  if (a.ofPlanes) return PointKey::edgeTriangle(edge(b), other(a));
  if (b.ofPlanes) return PointKey::edgeTriangle(edge(a), other(b));
  return PointKey::edgeEdge(edge(a), edge(b));
}

}  // namespace mandoline::detail
