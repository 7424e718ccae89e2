#include "mesh/intersections.h"

#include <algorithm>

namespace mandoline::detail {

Intersections::Intersections(const WeldedMesh& mesh) : mesh_(mesh) {
  for (const Stitch& stitch : mesh.stitches) {
    auto& side = stitchedSides_.emplace_back(1, stitch.low);
    side.insert(side.end(), stitch.vertices.begin(), stitch.vertices.end());
    side.push_back(stitch.high);
  }
}

Intersections::Outline Intersections::outline(uint32_t t) const {
  Outline o{mesh_.triangles[t], {}, {}};
  for (int i = 0; i < 3; ++i) {
    const uint32_t from = o.corners[i], to = o.corners[(i + 1) % 3];
    o.ends[i] = {std::min(from, to), std::max(from, to)};
    const auto endsOf = [](const std::vector<uint32_t>& side) { return std::array<uint32_t, 2>{side.front(), side.back()}; };
    const auto at = std::lower_bound(stitchedSides_.begin(), stitchedSides_.end(), o.ends[i],
                                     [&](const std::vector<uint32_t>& side, const auto& ends) { return endsOf(side) < ends; });
    if (at != stitchedSides_.end() && endsOf(*at) == o.ends[i]) o.stitched[i] = &*at;
  }
  return o;
}

bool Intersections::meet(uint32_t s, uint32_t t) {
  const Outline a = outline(s), b = outline(t);
  findShared(a, b);
  return shared_.size() > 1 ? meetAlongSides(a, b) : meetBeyondVertex(a, b);
}

void Intersections::findShared(const Outline& a, const Outline& b) {
  shared_.clear();
  const auto add = [&](uint32_t v) {
    for (int i = 0; i < 3; ++i) {
      const Vertices side = b.side(i);
      if (std::find(side.begin(), side.end(), v) == side.end()) continue;
      shared_.push_back(v);
      return;
    }
  };
  for (int i = 0; i < 3; ++i) {
    add(a.corners[i]);
    const Vertices side = a.side(i);
    for (size_t k = 1; k + 1 < side.size(); ++k) add(side[k]);
  }
}

bool Intersections::isShared(uint32_t v) const { return std::find(shared_.begin(), shared_.end(), v) != shared_.end(); }

/// The side on which all shared vertices lie next to each other, or -1.
int Intersections::sharedSide(const Outline& a) const {
  for (int i = 0; i < 3; ++i) {
    const Vertices side = a.side(i);
    size_t first = side.size(), past = 0, count = 0;
    for (size_t k = 0; k < side.size(); ++k) {
      if (!isShared(side[k])) continue;
      first = std::min(first, k);
      past = k + 1;
      ++count;
    }
    if (count == shared_.size() && past - first == count) return i;
  }
  return -1;
}

/// Of triangles with several shared vertices: the segments between these, which both hold, have to be edges of both, and all they hold.
bool Intersections::meetAlongSides(const Outline& a, const Outline& b) {
  const int i = sharedSide(a), j = sharedSide(b);
  if (i < 0 || j < 0) return true;
  const uint32_t low = a.ends[i][0], high = a.ends[i][1];
  if (orient(low, high, a.apex(i), b.apex(j)) == 0) {
    const int axis = axisAcross(a);
    if (orient(low, high, a.apex(i), axis) == orient(low, high, b.apex(j), axis)) return true;
  }
  const auto reachesInto = [&](const std::array<uint32_t, 2>& ends, const std::array<uint32_t, 2>& side) {
    return std::any_of(ends.begin(), ends.end(), [&](uint32_t v) { return !isShared(v) && isBetween(v, side[0], side[1]); });
  };
  return reachesInto(a.ends[i], b.ends[j]) || reachesInto(b.ends[j], a.ends[i]);
}

/// Of triangles with one shared vertex or none. What they have in common is convex: if there is more to it than that vertex, it reaches a
/// side of one of them that the vertex is not on.
bool Intersections::meetBeyondVertex(const Outline& a, const Outline& b) {
  if (liesBeside(a, b) || liesBeside(b, a)) return false;
  const auto anySideMeets = [&](const Outline& s, const Outline& t) {
    for (int i = 0; i < 3; ++i) {
      const Vertices side = s.side(i);
      const bool away = shared_.empty() || std::find(side.begin(), side.end(), shared_[0]) == side.end();
      if (away && segmentMeets(s.ends[i][0], s.ends[i][1], t)) return true;
    }
    return false;
  };
  return anySideMeets(a, b) || anySideMeets(b, a);
}

/// Whether all of a that is not shared lies on one side of b's plane.
bool Intersections::liesBeside(const Outline& a, const Outline& b) {
  int least = 1, greatest = -1;
  for (const uint32_t v : a.corners) {
    if (isShared(v)) continue;
    const int side = orient(b.corners[0], b.corners[1], b.corners[2], v);
    least = std::min(least, side);
    greatest = std::max(greatest, side);
    if (least <= 0 && greatest >= 0) return false;
  }
  return true;
}

bool Intersections::segmentMeets(uint32_t p, uint32_t q, const Outline& t) {
  const auto& [a, b, c] = t.corners;
  const int sideOfP = orient(a, b, c, p), sideOfQ = orient(a, b, c, q);
  if (sideOfP * sideOfQ > 0) return false;
  if (sideOfP == 0 && sideOfQ == 0) return segmentMeetsInPlane(p, q, t);
  const int ab = orient(p, q, a, b), bc = orient(p, q, b, c), ca = orient(p, q, c, a);
  return std::min({ab, bc, ca}) >= 0 || std::max({ab, bc, ca}) <= 0;
}

/// A segment and a triangle in one plane are apart if and only if one of the four lines that they lie along has them on different sides.
bool Intersections::segmentMeetsInPlane(uint32_t p, uint32_t q, const Outline& t) {
  const int axis = axisAcross(t), turn = orient(t.corners[0], t.corners[1], t.corners[2], axis);
  int left = 0, right = 0;
  for (int i = 0; i < 3; ++i) {
    const uint32_t from = t.corners[i], to = t.corners[(i + 1) % 3];
    if (orient(from, to, p, axis) == -turn && orient(from, to, q, axis) == -turn) return false;
    const int side = orient(p, q, from, axis);
    left += side > 0;
    right += side < 0;
  }
  return left < 3 && right < 3;
}

/// Whether v lies on the segment, if it lies on its line.
bool Intersections::isBetween(uint32_t v, uint32_t p, uint32_t q) const {
  const auto [low, high] = std::minmax(mesh_.points[p], mesh_.points[q]);  // lexicographic: the order along a line
  return low <= mesh_.points[v] && mesh_.points[v] <= high;
}

int Intersections::orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const auto& points = mesh_.points;
  return predicates_.orient3d(points[a].data(), points[b].data(), points[c].data(), points[d].data());
}

/// Which way a, b, c turn, seen along an axis.
int Intersections::orient(uint32_t a, uint32_t b, uint32_t c, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Point &pa = mesh_.points[a], &pb = mesh_.points[b], &pc = mesh_.points[c];
  return predicates_.orient2d({pa[u], pa[v]}, {pb[u], pb[v]}, {pc[u], pc[v]});
}

/// An axis that the triangle's plane is not parallel to, so that orientations in the plane are those seen along it.
int Intersections::axisAcross(const Outline& t) {
  int axis = 0;
  while (axis < 2 && orient(t.corners[0], t.corners[1], t.corners[2], axis) == 0) ++axis;
  return axis;
}

}  // namespace mandoline::detail
