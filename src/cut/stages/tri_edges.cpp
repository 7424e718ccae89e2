#include "cut/stages/tri_edges.h"

namespace mandoline::detail {
namespace {

const Stitch* findStitch(const Input& input, uint32_t low, uint32_t high) {
  const auto at = std::lower_bound(input.stitches.begin(), input.stitches.end(), std::array<uint32_t, 2>{low, high},
                                   [](const Stitch& s, const auto& key) {
                                     return std::array<uint32_t, 2>{s.low, s.high} < key;
                                   });
  return at != input.stitches.end() && at->low == low && at->high == high ? &*at : nullptr;
}

/// One use of a tri-edge by a side of a triangle, kept in the bucket of its lower end.
struct Use {
  uint32_t high, slot;
};

/// Sides that are stitched count as several; slots beyond the 3 T sides are theirs.
struct Sides {
  struct Extra {
    uint32_t low, high, triangle;
  };
  std::vector<Extra> extras;
  std::vector<uint32_t> stitchedOffsets{0};  // into extras
};

template <class F>
void forPlainSides(const Input& input, const F& f) {
  for (uint32_t t = 0; t < input.triangles.size(); ++t) {
    if (!input.kept(t)) continue;
    const auto& v = input.triangles[t];
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t a = v[i], b = v[i == 2 ? 0 : i + 1];
      f(std::min(a, b), std::max(a, b), 3 * t + i);
    }
  }
}

/// Marks the higher one of two triangles with the same vertices among the users of one tri-edge.
void dropDuplicates(Input& input, std::span<const Use> users, const Sides& sides, CutStats& stats) {
  const auto triangleOf = [&](const Use& use) {
    const size_t plain = 3 * input.triangles.size();
    return use.slot < plain ? use.slot / 3 : sides.extras[use.slot - plain].triangle;
  };
  const auto corners = [&](uint32_t t) {
    auto v = input.triangles[t];
    std::sort(v.begin(), v.end());
    return v;
  };
  const auto drop = [&](uint32_t s, uint32_t t) {
    TriangleState& state = input.states[std::max(s, t)];
    if (s == t || state != TriangleState::kept) return;
    state = TriangleState::duplicate;
    ++stats.duplicateTriangles;
  };
  if (users.size() == 2) {
    // Duplicates share all three sides, so one side of the first is enough to look at.
    if (users[0].slot < 3 * input.triangles.size() && users[0].slot % 3 != 0) return;
    if (corners(triangleOf(users[0])) == corners(triangleOf(users[1]))) drop(triangleOf(users[0]), triangleOf(users[1]));
    return;
  }
  std::vector<uint32_t> triangles;
  for (const Use& use : users) triangles.push_back(triangleOf(use));
  std::sort(triangles.begin(), triangles.end(), [&](uint32_t s, uint32_t t) {
    const auto a = corners(s), b = corners(t);
    return a != b ? a < b : s < t;
  });
  for (size_t i = 1; i < triangles.size(); ++i) {
    if (corners(triangles[i]) == corners(triangles[i - 1])) drop(triangles[i], triangles[i - 1]);
  }
}

void findUniqueEdges(Input& input, TriEdges& edges, CutStats& stats) {
  Sides sides;
  edges.sideEdges.assign(3 * input.triangles.size(), 0);
  if (!input.stitches.empty()) {
    forPlainSides(input, [&](uint32_t low, uint32_t high, uint32_t slot) {
      const Stitch* stitch = findStitch(input, low, high);
      if (!stitch) return;
      edges.sideEdges[slot] = TriEdges::kStitched + uint32_t(sides.stitchedOffsets.size() - 1);
      uint32_t from = low;
      for (size_t i = 0; i <= stitch->vertices.size(); ++i) {
        const uint32_t to = i < stitch->vertices.size() ? stitch->vertices[i] : high;
        sides.extras.push_back({std::min(from, to), std::max(from, to), slot / 3});
        from = to;
      }
      sides.stitchedOffsets.push_back(uint32_t(sides.extras.size()));
    });
  }
  const auto forUses = [&](const auto& f) {
    forPlainSides(input, [&](uint32_t low, uint32_t high, uint32_t slot) {
      if (edges.sideEdges[slot] < TriEdges::kStitched) f(low, high, slot);
    });
    for (size_t i = 0; i < sides.extras.size(); ++i) f(sides.extras[i].low, sides.extras[i].high, uint32_t(3 * input.triangles.size() + i));
  };

  std::vector<uint32_t> offsets(input.points.size() + 1, 0);
  forUses([&](uint32_t low, uint32_t, uint32_t) { ++offsets[low + 1]; });
  for (size_t v = 0; v + 1 < offsets.size(); ++v) offsets[v + 1] += offsets[v];
  std::vector<Use> uses(offsets.back());
  {
    std::vector<uint32_t> at(offsets.begin(), offsets.end() - 1);
    forUses([&](uint32_t low, uint32_t high, uint32_t slot) { uses[at[low]++] = {high, slot}; });
  }
  std::vector<uint32_t> extraEdges(sides.extras.size());
  edges.ends.reserve(uses.size() / 2 + 16);
  for (uint32_t low = 0; low < input.points.size(); ++low) {
    const std::span<Use> bucket(uses.data() + offsets[low], offsets[low + 1] - offsets[low]);
    const auto before = [](const Use& a, const Use& b) { return a.high != b.high ? a.high < b.high : a.slot < b.slot; };
    if (bucket.size() > 24) {
      std::sort(bucket.begin(), bucket.end(), before);
    } else {
      for (size_t i = 1; i < bucket.size(); ++i) {
        const Use use = bucket[i];
        size_t j = i;
        for (; j > 0 && before(use, bucket[j - 1]); --j) bucket[j] = bucket[j - 1];
        bucket[j] = use;
      }
    }
    for (size_t i = 0, end; i < bucket.size(); i = end) {
      for (end = i + 1; end < bucket.size() && bucket[end].high == bucket[i].high;) ++end;
      for (size_t j = i; j < end; ++j) {
        const size_t slot = bucket[j].slot, plain = edges.sideEdges.size();
        (slot < plain ? edges.sideEdges[slot] : extraEdges[slot - plain]) = uint32_t(edges.ends.size());
      }
      edges.ends.push_back({low, bucket[i].high});
      if (end - i > 1) dropDuplicates(input, bucket.subspan(i, end - i), sides, stats);
    }
  }
  edges.stitched.offsets = sides.stitchedOffsets;
  edges.stitched.items = extraEdges;
}

struct AxialPlane {
  int axis;
  double coordinate;
};

/// P1: order of the crossings of edge a -> b with two planes, by place along the edge.
int compareCrossings(const Point& a, const Point& b, const AxialPlane& u, const AxialPlane& v, Predicates& predicates) {
  const auto [d, x] = u;
  const auto [e, y] = v;
  const double s = (x - a[d]) / (b[d] - a[d]), t = (y - a[e]) / (b[e] - a[e]);
  constexpr double bound = 10 * kRoundoff;  // each is in [0, 1] and has three roundings
  if (std::fabs(s - t) > bound) return signOf(s - t);
  // (x - a.d) (b.e - a.e) - (y - a.e) (b.d - a.d) has the sign of (s - t) (b.d - a.d) (b.e - a.e), and is the orientation of (b, (x, y))
  // about a.
  const int orientation = -predicates.orient2d({a[d], a[e]}, {b[d], b[e]}, {x, y});
  return (b[d] > a[d]) == (b[e] > a[e]) ? orientation : -orientation;
}

/// Writes the slabs of an edge's crossings, from its lower end on, to `out`; returns how many. Crossings at one point are one.
size_t crossEdge(const Input& input, const std::array<uint32_t, 2>& ends, Slab* out, Predicates& predicates) {
  const Slab &from = input.slabs[ends[0]], &to = input.slabs[ends[1]];
  Slab at = from;  // slabs just before the next crossing
  int step[3];
  int32_t next[3], last[3];
  for (int d = 0; d < 3; ++d) {
    step[d] = (to[d] > from[d]) - (to[d] < from[d]);
    next[d] = step[d] > 0 ? firstPlaneAfter(from[d]) : lastPlaneBefore(from[d]);
    last[d] = step[d] > 0 ? lastPlaneBefore(to[d]) : firstPlaneAfter(to[d]);
    if (onPlane(from[d])) at[d] += step[d];
  }
  const auto pending = [&](int d) { return step[d] > 0 ? next[d] <= last[d] : step[d] < 0 && next[d] >= last[d]; };
  size_t count = 0;
  for (;;) {
    int first = -1;
    bool tied[3] = {};
    for (int d = 0; d < 3; ++d) {
      if (!pending(d)) continue;
      const auto planeOf = [&](int axis) { return AxialPlane{axis, input.planes[axis][next[axis]]}; };
      const int order =
          first < 0 ? -1 : compareCrossings(input.points[ends[0]], input.points[ends[1]], planeOf(d), planeOf(first), predicates);
      if (order < 0) tied[0] = tied[1] = tied[2] = false;
      if (order <= 0) tied[d] = true;
      if (order < 0) first = d;
    }
    if (first < 0) return count;
    Slab crossing = at;
    for (int d = 0; d < 3; ++d) {
      if (!tied[d]) continue;
      crossing[d] = 2 * next[d];
      at[d] = crossing[d] + step[d];
      next[d] += step[d];
    }
    out[count++] = crossing;
  }
}

uint32_t crossingBound(const Slab& a, const Slab& b) {
  uint32_t count = 0;
  for (int d = 0; d < 3; ++d) {
    const int32_t first = firstPlaneAfter(std::min(a[d], b[d])), last = lastPlaneBefore(std::max(a[d], b[d]));
    if (last >= first) count += uint32_t(last - first + 1);
  }
  return count;
}

/// Pieces of tri-edges that lie in an axial plane, but not on a grid line.
void collectInPlane(const Input& input, TriEdges& edges, const CutVertices& vertices) {
  for (size_t e = 0; e < edges.ends.size(); ++e) {
    const Slab &a = input.slabs[edges.ends[e][0]], &b = input.slabs[edges.ends[e][1]];
    bool lies = false;
    for (int d = 0; d < 3; ++d) lies |= a[d] == b[d] && onPlane(a[d]);
    if (!lies) continue;
    uint32_t from = edges.ends[e][0];
    const auto piece = [&](uint32_t to) {
      const Slab element = elementBetween(vertices.slabs[from], vertices.slabs[to]);
      if (planeCount(element) == 1 && input.inGrid(element)) edges.inPlane.push_back({element, from, to});
      from = to;
    };
    for (uint32_t v = edges.crossingOffsets[e]; v < edges.crossingOffsets[e + 1] && vertices.slabs[v][0] != CutVertices::kUnused; ++v)
      piece(v);
    piece(edges.ends[e][1]);
  }
}

}  // namespace

void cutTriEdges(Surface& surface, Run& run) {
  Input& input = surface.input;
  TriEdges& edges = surface.edges;
  CutVertices& vertices = surface.vertices;
  findUniqueEdges(input, edges, run.stats);
  const size_t edgeCount = edges.ends.size();
  vertices.input = &input;
  vertices.triEdges = &edges.ends;
  vertices.firstOnEdge = uint32_t(input.points.size());
  edges.crossingOffsets.resize(edgeCount + 1);
  uint64_t total = vertices.firstOnEdge;
  for (size_t e = 0; e < edgeCount; ++e) {
    edges.crossingOffsets[e] = uint32_t(total);
    total += crossingBound(input.slabs[edges.ends[e][0]], input.slabs[edges.ends[e][1]]);
    if (total >= uint64_t(1) << 31) throw Failure{{Status::meshTooLarge, -1, -1, "The cut-mesh would have more than 2^31 vertices."}};
  }
  edges.crossingOffsets[edgeCount] = uint32_t(total);
  vertices.firstInTriangle = vertices.firstOnGrid = uint32_t(total);
  vertices.slabs = input.slabs;
  vertices.slabs.resize(total);
  vertices.parents.resize(total - vertices.firstOnEdge);
  const auto chunks = forChunks<Predicates>(edgeCount, run.monitor, [&](Predicates& predicates, size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      const uint32_t first = edges.crossingOffsets[e], past = edges.crossingOffsets[e + 1];
      if (first == past) continue;
      const size_t count = crossEdge(input, edges.ends[e], &vertices.slabs[first], predicates);
      for (uint32_t v = first; v < past; ++v) {
        vertices.parents[v - vertices.firstOnEdge] = uint32_t(e);
        if (v >= first + count) vertices.slabs[v] = {CutVertices::kUnused, 1, 1};
      }
    }
  });
  for (const Predicates& p : chunks) run.count(p);
  collectInPlane(input, edges, vertices);
}

}  // namespace mandoline::detail
