#include "mesh/mesh_edges.h"

#include <algorithm>

#include "base/csr.h"
#include "base/large_array.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// One use of a tri-edge by a side of a triangle, kept in the bucket of its lower end: a number that sorts by the higher end, then by slot.
class SideUse {
 public:
  /// `slot`: 3 * triangle + side, or beyond: see Sides. `forward`: whether the triangle runs through the side from its lower end.
  SideUse(VertexId high, uint32_t slot, bool forward) : bits_(uint64_t(high.number) << 33 | uint64_t(slot) << 1 | uint64_t(forward)) {}
  SideUse() = default;

  VertexId high() const { return {uint32_t(bits_ >> 33)}; }
  uint32_t slot() const { return uint32_t(bits_ >> 1); }
  bool forward() const { return bits_ % 2 != 0; }
  auto operator<=>(const SideUse&) const = default;

 private:
  uint64_t bits_;
};

/// Sides that are stitched count as several; slots beyond the 3 T sides are theirs.
struct Sides {
  struct Extra {
    VertexId low, high;
    TriangleId triangle;
    bool forward;
  };
  std::vector<Extra> extras;
  std::vector<uint32_t> stitchedOffsets{0};  // into extras; behind the last of them come inner edges
};

template <class F>
void forSides(const WeldedMesh& mesh, const F& f) {
  for (const TriangleId t : mesh.triangleIds()) {
    if (!mesh.kept(t)) continue;
    const auto& v = mesh.triangles.data()[t.number];
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t a = v[i], b = v[i == 2 ? 0 : i + 1], low = std::min(a, b);  // numbers: without branches, hard to predict
      f(VertexId{low}, SideUse(VertexId{std::max(a, b)}, 3 * t.number + i, a == low));
    }
  }
}

/// Whether triangles with the same vertices have the same normal.
bool sameWay(const std::array<VertexId, 3>& a, const std::array<VertexId, 3>& b) {
  const size_t at = size_t(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return b[(at + 1) % 3] == a[1];
}

TriangleId triangleOf(const WeldedMesh& mesh, const Sides& sides, const SideUse& use) {
  const size_t sideCount = 3 * mesh.triangles.size();
  return use.slot() < sideCount ? TriangleId{use.slot() / 3} : sides.extras[use.slot() - sideCount].triangle;
}

/// Marks the higher one of two triangles with the same vertices among the users of one tri-edge.
void dropDuplicates(WeldedMesh& mesh, std::span<const SideUse> users, const Sides& sides) {
  const auto corners = [&](TriangleId t) {
    auto v = mesh.verticesOf(t);
    sortItems(v);
    return v;
  };
  const auto drop = [&](TriangleId s, TriangleId t) {
    TriangleState& state = mesh.states[std::max(s, t).number];
    if (s == t || state != TriangleState::kept) return;
    state = TriangleState::duplicate;
    mesh.duplicates.push_back({std::min(s, t).number, std::max(s, t).number, sameWay(mesh.verticesOf(s), mesh.verticesOf(t))});
  };
  std::vector<TriangleId> triangles;
  for (const SideUse& use : users) triangles.push_back(triangleOf(mesh, sides, use));
  sortItems(triangles, [&](TriangleId s, TriangleId t) {
    const auto a = corners(s), b = corners(t);
    return a != b ? a < b : s < t;
  });
  for (size_t i = 1, original = 0; i < triangles.size(); ++i) {
    if (corners(triangles[i]) != corners(triangles[original])) original = i;
    drop(triangles[i], triangles[original]);
  }
}

/// Finds edges at which triangles may have the same vertices, without a look at the triangles, which are far apart in memory.
class SameTriangles {
 public:
  /// `sideCount`: of all triangles; slots from there on are extras.
  explicit SameTriangles(size_t sideCount) : sideCount_(sideCount) {}

  /// What follows are the edges with another lower end.
  void beginBucket() { pairs_ = 0; }
  /// The users of the next edge. Two triangles that are the same share both edges at their lowest corner: unless one of these has more
  /// users, the same pair comes twice.
  bool mayBeAmong(std::span<const SideUse> users) {
    if (users.size() != 2) return users.size() > 2;
    if (users[1].slot() >= sideCount_) return true;
    const uint32_t pair = (users[0].slot() / 3) * 0x9e3779b1u ^ (users[1].slot() / 3) * 0x85ebca6bu;  // a collision costs a look
    const uint64_t bit = uint64_t(1) << (pair >> 26);
    const bool isKnown = (pairs_ & bit) != 0;
    pairs_ |= bit;
    return isKnown;
  }

 private:
  size_t sideCount_;
  uint64_t pairs_ = 0;  // of triangles that are the only ones at an edge of the bucket
};

/// What the users of all edges tell.
struct AllUsers {
  bool closed = true, oriented = true;
  IdVector<TriangleId, uint8_t> unpaired;  // see MeshEdges

  void add(const WeldedMesh& mesh, const Sides& sides, std::span<const SideUse> users) {
    size_t forwards = 0;
    for (const SideUse& use : users) forwards += use.forward();
    closed &= 2 * forwards == users.size();
    if (users.size() == 2) {
      oriented &= forwards == 1;
      return;
    }
    if (unpaired.empty()) unpaired.resize(mesh.triangles.size());
    for (const SideUse& use : users) unpaired[triangleOf(mesh, sides, use)] = 1;
  }
};

/// Divides the stitched sides, and adds the inner edges.
Sides findStitchedSides(const WeldedMesh& mesh, const Arrangement* arrangement, MeshEdges& edges) {
  Sides sides;
  if (!mesh.stitches.empty()) {
    forSides(mesh, [&](VertexId low, const SideUse& use) {
      const Stitch* stitch = mesh.findStitch(low.number, use.high().number);
      if (!stitch) return;
      edges.sideEdges[use.slot()] = MeshEdges::kStitched + uint32_t(sides.stitchedOffsets.size() - 1);
      VertexId from = low;
      for (size_t i = 0; i <= stitch->vertices.size(); ++i) {
        const VertexId to = i < stitch->vertices.size() ? VertexId{stitch->vertices[i]} : use.high();
        sides.extras.push_back({std::min(from, to), std::max(from, to), TriangleId{use.slot() / 3}, use.forward() == (from < to)});
        from = to;
      }
      sides.stitchedOffsets.push_back(uint32_t(sides.extras.size()));
    });
  }
  for (size_t t = 0; arrangement && t < arrangement->innerEdges.size(); ++t) {
    for (const InnerEdge& e : arrangement->innerEdges[t]) sides.extras.push_back({{e.low}, {e.high}, {uint32_t(t)}, true});
  }
  return sides;
}

/// Moves the edges of what lies beyond the sides to where they belong.
void takeExtras(const Sides& sides, const Arrangement* arrangement, MeshEdges& edges) {
  std::vector<TriEdgeId>& stitched = edges.stitched.items;
  std::vector<TriEdgeId>& inner = edges.inner.items;
  const size_t sideCount = edges.sideEdges.size() - sides.extras.size(), firstInner = sideCount + sides.stitchedOffsets.back();
  stitched.reserve(firstInner - sideCount);
  inner.reserve(edges.sideEdges.size() - firstInner);
  for (size_t slot = sideCount; slot < edges.sideEdges.size(); ++slot) {
    (slot < firstInner ? stitched : inner).push_back({edges.sideEdges[slot]});
  }
  edges.stitched.offsets = sides.stitchedOffsets;
  if (arrangement && arrangement->innerEdges.size() > 0) edges.inner.offsets = arrangement->innerEdges.offsets;
  edges.sideEdges.resize(sideCount);
}

/// The lines that tri-edges with made ends lie on.
void findLines(const Arrangement& arrangement, MeshEdges& edges) {
  for (const auto& ends : edges.ends) {
    const uint32_t low = ends[0].number, high = ends[1].number;
    const MadeEdge* made = arrangement.points.isMade(high) ? arrangement.findMade(low, high) : nullptr;
    edges.lines.push_back(made ? made->line : Line{low, high, false});
  }
}

/// The uses by sides of triangles. `ends`: where the bucket of each vertex ends. `hasDuplicates`: whether those of duplicates are among
/// them.
EdgeUses usesOfSides(const WeldedMesh& mesh, const Sides& sides, const LargeVector<SideUse>& all, std::span<const uint32_t> ends,
                     bool hasDuplicates) {
  const size_t slots = 3 * mesh.triangles.size() + sides.stitchedOffsets.back();  // then come those of inner edges
  EdgeUses uses;
  uses.items.reserve(all.size());
  uses.offsets.reserve(all.size() / 2 + 16);
  const SideUse* use = all.data();
  for (const uint32_t end : ends) {
    for (const SideUse* const past = all.data() + end; use != past;) {
      for (const VertexId high = use->high(); use != past && use->high() == high; ++use) {
        if (use->slot() >= slots) continue;
        const TriangleId t = triangleOf(mesh, sides, *use);
        uses.items.push_back({2 * t.number + use->forward()});
        if (hasDuplicates) continue;
        for (const Duplicate& d : mesh.duplicatesOf(t)) uses.items.push_back({2 * d.triangle + (use->forward() == d.sameWay)});
      }
      uses.endGroup();
    }
  }
  return uses;
}

}  // namespace

MeshEdges findMeshEdges(WeldedMesh& mesh, const Arrangement* arrangement, EdgeUses* usesIfOpen) {
  MeshEdges edges;
  edges.sideEdges.assign(3 * mesh.triangles.size(), 0);
  const Sides sides = findStitchedSides(mesh, arrangement, edges);
  const bool anyStitched = !mesh.stitches.empty();
  const auto forUses = [&](const auto& f) {
    forSides(mesh, [&](VertexId low, const SideUse& use) {
      if (!anyStitched || edges.sideEdges[use.slot()] < MeshEdges::kStitched) f(low, use);
    });
    for (size_t i = 0; i < sides.extras.size(); ++i) {
      const auto& [low, high, triangle, forward] = sides.extras[i];
      f(low, SideUse(high, uint32_t(3 * mesh.triangles.size() + i), forward));
    }
  };

  const size_t vertices = arrangement ? arrangement->points.size() : mesh.points.size();
  std::vector<uint32_t> offsets(vertices + 1, 0);
  forUses([&](VertexId low, const SideUse&) { ++offsets[low.number]; });
  LargeVector<SideUse> uses(toOffsets(offsets));
  forUses([&](VertexId low, const SideUse& use) { uses[offsets[low.number]++] = use; });  // now they are where the next bucket starts
  edges.sideEdges.reserve(3 * mesh.triangles.size() + sides.extras.size());               // no more: it is kept
  edges.sideEdges.resize(3 * mesh.triangles.size() + sides.extras.size());
  edges.ends.reserve(offsets.back() / 2 + 16);
  AllUsers found;
  uint32_t* const edgeOf = edges.sideEdges.data();
  SameTriangles same(3 * mesh.triangles.size());
  size_t begin = 0;
  for (const VertexId low : Ids<VertexId>(vertices)) {
    const std::span<SideUse> bucket(uses.data() + begin, offsets[low.number] - begin);
    begin = offsets[low.number];
    sortItems(bucket);
    same.beginBucket();
    for (SideUse *use = bucket.data(), *const past = use + bucket.size(); use != past;) {
      SideUse* const first = use;
      const VertexId high = use->high();
      const uint32_t edge = uint32_t(edges.ends.size());
      for (; use != past && use->high() == high; ++use) edgeOf[use->slot()] = edge;
      found.add(mesh, sides, {first, use});
      edges.ends.push_back({low, high});
      if (same.mayBeAmong({first, use})) dropDuplicates(mesh, {first, use}, sides);
    }
  }
  if (!arrangement) {
    mesh.closed = found.closed;
    mesh.oriented = found.oriented;
    sortItems(mesh.duplicates);
  }
  if (usesIfOpen && !mesh.closed) {
    *usesIfOpen = usesOfSides(mesh, sides, uses, std::span(offsets).first(vertices), !arrangement);
  }
  takeExtras(sides, arrangement, edges);
  edges.unpaired = std::move(found.unpaired);
  if (arrangement && !arrangement->madeEdges.empty()) findLines(*arrangement, edges);
  return edges;
}

}  // namespace mandoline::detail
