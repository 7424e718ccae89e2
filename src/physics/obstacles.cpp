#include "physics/obstacles.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace mandoline::physics {
namespace {

using detail::Box;
using detail::Point2;
using detail::Predicates;

Box boxOf(std::span<const Point> points) {
  Box box{points[0], points[0]};
  for (const Point& p : points) box.include({p, p});
  return box;
}

/// The point without one of its coordinates.
Point2 flat(const Point& p, size_t axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// An axis that the triangle is seen along with an area; 3 if it has none.
size_t axisWithArea(const Triangle& t, Predicates& predicates) {
  size_t axis = 0;
  while (axis < 3 && predicates.orient2d(flat(t[0], axis), flat(t[1], axis), flat(t[2], axis)) == 0) ++axis;
  return axis;
}

bool isBetween(double x, double a, double b) { return std::min(a, b) <= x && x <= std::max(a, b); }

/// Whether two segments in a plane have a point in common.
bool meetInPlane(const std::array<Point2, 2>& s, const std::array<Point2, 2>& t, Predicates& predicates) {
  const int t0 = predicates.orient2d(s[0], s[1], t[0]), t1 = predicates.orient2d(s[0], s[1], t[1]);
  const int s0 = predicates.orient2d(t[0], t[1], s[0]), s1 = predicates.orient2d(t[0], t[1], s[1]);
  if (t0 * t1 < 0 && s0 * s1 < 0) return true;
  const auto isOn = [](const std::array<Point2, 2>& line, const Point2& p) {  // which is on the line through its ends
    return isBetween(p.x, line[0].x, line[1].x) && isBetween(p.y, line[0].y, line[1].y);
  };
  return (t0 == 0 && isOn(s, t[0])) || (t1 == 0 && isOn(s, t[1])) || (s0 == 0 && isOn(t, s[0])) || (s1 == 0 && isOn(t, s[1]));
}

bool meetsInPlane(const Segment& segment, const Triangle& triangle, Predicates& predicates) {
  const size_t axis = axisWithArea(triangle, predicates);
  const std::array<Point2, 2> s = {flat(segment.from, axis), flat(segment.to, axis)};
  const std::array<Point2, 3> t = {flat(triangle[0], axis), flat(triangle[1], axis), flat(triangle[2], axis)};
  int left = 0, right = 0;  // how many sides the start is on the left of
  for (size_t i = 0; i < 3; ++i) {
    if (meetInPlane(s, {t[i], t[(i + 1) % 3]}, predicates)) return true;
    (predicates.orient2d(t[i], t[(i + 1) % 3], s[0]) > 0 ? left : right) += 1;
  }
  return left == 3 || right == 3;
}

/// Whether they have a point in common, their borders included.
bool meets(const Segment& segment, const Triangle& triangle, Predicates& predicates) {
  const auto& [a, b, c] = triangle;
  const double *p = segment.from.data(), *q = segment.to.data();
  const int from = predicates.orient3d(a.data(), b.data(), c.data(), p), to = predicates.orient3d(a.data(), b.data(), c.data(), q);
  if (from * to > 0) return false;
  if (from == 0 && to == 0) return meetsInPlane(segment, triangle, predicates);
  int low = 1, high = -1;  // of the turns of the sides about the segment's line
  for (size_t i = 0; i < 3; ++i) {
    const int turn = predicates.orient3d(p, q, triangle[i].data(), triangle[(i + 1) % 3].data());
    low = std::min(low, turn), high = std::max(high, turn);
  }
  return low >= 0 || high <= 0;
}

/// The power of two that brings the coordinates of both into the range of exact arithmetic.
detail::Scale scaleOf(const MeshView& mesh, const Grid& grid) {
  double largest = 0;
  for (const auto& planes : grid.planes) largest = std::max({largest, std::fabs(planes.front()), std::fabs(planes.back())});
  for (const uint32_t v : mesh.triangles) {
    for (size_t d = 0; d < 3; ++d) largest = std::max(largest, std::fabs(mesh.positions[3 * size_t(v) + d]));
  }
  return detail::Scale(largest > 0 ? detail::Scale::kLargestExponent - std::ilogb(largest) : 0);
}

}  // namespace

Obstacles::Obstacles(const MeshView& mesh, const Grid& grid) : scale_(scaleOf(mesh, grid)) {
  Predicates predicates;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    Triangle triangle;
    for (size_t i = 0; i < 3; ++i) {
      const double* p = &mesh.positions[3 * size_t(mesh.triangles[3 * t + i])];
      triangle[i] = scaled({p[0], p[1], p[2]});
    }
    if (axisWithArea(triangle, predicates) < 3) triangles_.push_back(triangle);
  }
  tree_.build(triangles_.size(), [&](size_t t) { return detail::BoxTree::Item{boxOf(triangles_[t]), uint32_t(t)}; });
}

Point Obstacles::scaled(const Point& p) const {
  uint32_t flushed = 0;
  return {scale_.scaled(p[0], flushed), scale_.scaled(p[1], flushed), scale_.scaled(p[2], flushed)};
}

bool Obstacles::isFree(const Segment& segment, Predicates& predicates) const {
  const Segment mine{scaled(segment.from), scaled(segment.to)};
  bool result = true;
  const Point ends[] = {mine.from, mine.to};
  tree_.forOverlapping(boxOf(ends), [&](uint32_t t) { result = result && !meets(mine, triangles_[t], predicates); });
  return result;
}

Point Obstacles::reached(const Segment& segment, Predicates& predicates) const {
  double free = 0, beyond = 1;
  Point last = segment.from;
  for (double middle = 0.5; middle > free && middle < beyond; middle = free + (beyond - free) / 2) {
    Point p;
    for (size_t d = 0; d < 3; ++d) p[d] = segment.from[d] + middle * (segment.to[d] - segment.from[d]);
    if (p == segment.from || (beyond < 1 && beyond - free < 0x1p-60)) break;
    if (isFree({segment.from, p}, predicates)) {
      free = middle;
      last = p;
    } else {
      beyond = middle;
    }
  }
  return last;
}

}  // namespace mandoline::physics
