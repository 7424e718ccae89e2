#include "mesh/intersections.h"

#include <string>

namespace mandoline::detail {
namespace {

struct Box {
  Point low, high;

  bool overlaps(const Box& other) const {
    for (int d = 0; d < 3; ++d) {
      if (low[d] > other.high[d] || high[d] < other.low[d]) return false;
    }
    return true;
  }
  void include(const Box& other) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], other.low[d]);
      high[d] = std::max(high[d], other.high[d]);
    }
  }
};

Box boxOf(const Input& input, uint32_t t) {
  const auto& v = input.triangles[t];
  Box box{input.points[v[0]], input.points[v[0]]};
  for (int i = 1; i < 3; ++i) box.include({input.points[v[i]], input.points[v[i]]});
  return box;
}

/// Triangles that have no part in the cut because the grid ends before them can't have led to a contradiction.
bool reachesGrid(const Input& input, uint32_t t) {
  const auto& v = input.triangles[t];
  for (int d = 0; d < 3; ++d) {
    const int32_t a = input.slabs[v[0]][d], b = input.slabs[v[1]][d], c = input.slabs[v[2]][d];
    if (std::max({a, b, c}) < 0 || std::min({a, b, c}) > 2 * input.cells(d)) return false;
  }
  return true;
}

/// A balanced tree of the triangles' boxes: every node halves its triangles by their centres along the longest side of its box.
class BoxTree {
 public:
  explicit BoxTree(const Input& input) {
    for (uint32_t t = 0; t < input.triangles.size(); ++t) {
      if (input.kept(t) && reachesGrid(input, t)) items_.push_back({boxOf(input, t), t});
    }
    if (!items_.empty()) build(0, items_.size());
  }

  std::vector<uint32_t> triangles() const {
    std::vector<uint32_t> ids;
    for (const Item& item : items_) ids.push_back(item.triangle);
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  /// Calls f(triangle) for those whose boxes overlap the given one.
  template <class F>
  void forOverlapping(const Box& box, const F& f) const {
    for (size_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      const bool overlaps = node.box.overlaps(box);
      if (overlaps && node.past == n + 1) {
        for (size_t i = node.begin; i < node.end; ++i) {
          if (items_[i].box.overlaps(box)) f(items_[i].triangle);
        }
      }
      n = overlaps ? n + 1 : node.past;
    }
  }

 private:
  static constexpr size_t kLeaf = 8;

  struct Item {
    Box box;
    uint32_t triangle;
  };
  /// In depth-first order, so that past a node comes what is not below it; a leaf has nothing below.
  struct Node {
    Box box;
    size_t begin, end, past;
  };

  void build(size_t begin, size_t end) {
    const size_t n = nodes_.size();
    nodes_.push_back({items_[begin].box, begin, end, 0});
    for (size_t i = begin; i < end; ++i) nodes_[n].box.include(items_[i].box);
    if (end - begin > kLeaf) {
      const size_t middle = begin + (end - begin) / 2;
      int axis = 0;
      const auto length = [&](int d) { return nodes_[n].box.high[d] - nodes_[n].box.low[d]; };
      for (int d = 1; d < 3; ++d) {
        if (length(d) > length(axis)) axis = d;
      }
      const auto centre = [axis](const Item& item) { return item.box.low[axis] + item.box.high[axis]; };
      std::nth_element(items_.begin() + ptrdiff_t(begin), items_.begin() + ptrdiff_t(middle), items_.begin() + ptrdiff_t(end),
                       [&](const Item& a, const Item& b) { return centre(a) < centre(b); });
      build(begin, middle);
      build(middle, end);
    }
    nodes_[n].past = nodes_.size();
  }

  std::vector<Item> items_;
  std::vector<Node> nodes_;
};

}  // namespace

Intersections::Intersections(const Input& input) : input_(input) {
  for (const Stitch& stitch : input.stitches) {
    auto& side = stitchedSides_.emplace_back(1, stitch.low);
    side.insert(side.end(), stitch.vertices.begin(), stitch.vertices.end());
    side.push_back(stitch.high);
  }
}

Intersections::Outline Intersections::outline(uint32_t t) const {
  Outline o{input_.triangles[t], {}, {}};
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
  const auto [low, high] = std::minmax(input_.points[p], input_.points[q]);  // lexicographic: the order along a line
  return low <= input_.points[v] && input_.points[v] <= high;
}

int Intersections::orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const auto& points = input_.points;
  return predicates_.orient3d(points[a].data(), points[b].data(), points[c].data(), points[d].data());
}

/// Which way a, b, c turn, seen along an axis.
int Intersections::orient(uint32_t a, uint32_t b, uint32_t c, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Point &pa = input_.points[a], &pb = input_.points[b], &pc = input_.points[c];
  return predicates_.orient2d(pa[u], pa[v], pb[u], pb[v], pc[u], pc[v]);
}

/// An axis that the triangle's plane is not parallel to, so that orientations in the plane are those seen along it.
int Intersections::axisAcross(const Outline& t) {
  int axis = 0;
  while (axis < 2 && orient(t.corners[0], t.corners[1], t.corners[2], axis) == 0) ++axis;
  return axis;
}

Error explainContradiction(const Input& input, int64_t blamed, int64_t alsoBlamed, const CutStats& stats) {
  const auto name = [&](int64_t s, int64_t t) {
    const int64_t low = std::min(s, t), high = std::max(s, t);
    return Error{Status::selfIntersection, low, high,
                 "Triangles " + std::to_string(low) + " and " + std::to_string(high) + " meet other than in a shared vertex or edge" +
                     (stats.snappedVertices > 0 ? " after snapping." : ".")};
  };
  const auto isCandidate = [&](int64_t t) { return t >= 0 && input.kept(size_t(t)); };
  Intersections intersections(input);
  if (isCandidate(blamed) && isCandidate(alsoBlamed) && blamed != alsoBlamed &&
      intersections.meet(uint32_t(blamed), uint32_t(alsoBlamed))) {
    return name(blamed, alsoBlamed);
  }
  const BoxTree tree(input);
  const auto lowestPartner = [&](uint32_t t, uint32_t from) {
    int64_t lowest = -1;
    tree.forOverlapping(boxOf(input, t), [&](uint32_t s) {
      if (s >= from && s != t && (lowest < 0 || s < lowest) && intersections.meet(s, t)) lowest = s;
    });
    return lowest;
  };
  for (const int64_t t : {blamed, alsoBlamed}) {
    const int64_t partner = isCandidate(t) ? lowestPartner(uint32_t(t), 0) : -1;
    if (partner >= 0) return name(t, partner);
  }
  for (const uint32_t t : tree.triangles()) {
    const int64_t partner = lowestPartner(t, t + 1);
    if (partner >= 0) return name(t, partner);
  }
  return {Status::internalError, -1, -1,
          "The cut met a contradiction although no two triangles intersect. This is a fault of the library."};
}

}  // namespace mandoline::detail
