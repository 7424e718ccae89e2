#include "mesh/mesh_edges.h"

#include <algorithm>
#include <memory>

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// One use of a tri-edge by a side of a triangle, kept in the bucket of its lower end.
struct SideUse {
  uint32_t highAndWay;  ///< 2 * the higher end, + 1 if the triangle runs through the side from its lower end
  uint32_t slot;        ///< 3 * triangle + side, or beyond: see Sides

  VertexId high() const { return {highAndWay / 2}; }
  bool forward() const { return highAndWay % 2 != 0; }
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
void forPlainSides(const WeldedMesh& mesh, const F& f) {
  for (const TriangleId t : mesh.triangleIds()) {
    if (!mesh.kept(t)) continue;
    const auto v = mesh.verticesOf(t);
    for (uint32_t i = 0; i < 3; ++i) {
      const VertexId a = v[i], b = v[i == 2 ? 0 : i + 1];
      f(std::min(a, b), SideUse{2 * std::max(a, b).number + (a < b), 3 * t.number + i});
    }
  }
}

/// Whether triangles with the same vertices have the same normal.
bool sameWay(const std::array<VertexId, 3>& a, const std::array<VertexId, 3>& b) {
  const size_t at = size_t(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return b[(at + 1) % 3] == a[1];
}

/// Marks the higher one of two triangles with the same vertices among the users of one tri-edge.
void dropDuplicates(WeldedMesh& mesh, std::span<const SideUse> users, const Sides& sides) {
  const auto triangleOf = [&](const SideUse& use) {
    const size_t plain = 3 * mesh.triangles.size();
    return use.slot < plain ? TriangleId{use.slot / 3} : sides.extras[use.slot - plain].triangle;
  };
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
  if (users.size() == 2 && users[1].slot < 3 * mesh.triangles.size()) {
    const auto opposite = [&](const SideUse& use) { return mesh.triangles[use.slot / 3][(use.slot % 3 + 2) % 3]; };
    if (opposite(users[0]) == opposite(users[1])) drop(triangleOf(users[0]), triangleOf(users[1]));
    return;
  }
  std::vector<TriangleId> triangles;
  for (const SideUse& use : users) triangles.push_back(triangleOf(use));
  sortItems(triangles, [&](TriangleId s, TriangleId t) {
    const auto a = corners(s), b = corners(t);
    return a != b ? a < b : s < t;
  });
  for (size_t i = 1, original = 0; i < triangles.size(); ++i) {
    if (corners(triangles[i]) != corners(triangles[original])) original = i;
    drop(triangles[i], triangles[original]);
  }
}

/// Divides the stitched sides, and adds the inner edges.
Sides findStitchedSides(const WeldedMesh& mesh, const Arrangement* arrangement, MeshEdges& edges) {
  Sides sides;
  if (!mesh.stitches.empty()) {
    forPlainSides(mesh, [&](VertexId low, const SideUse& use) {
      const Stitch* stitch = mesh.findStitch(low.number, use.high().number);
      if (!stitch) return;
      edges.sideEdges[use.slot] = MeshEdges::kStitched + uint32_t(sides.stitchedOffsets.size() - 1);
      VertexId from = low;
      for (size_t i = 0; i <= stitch->vertices.size(); ++i) {
        const VertexId to = i < stitch->vertices.size() ? VertexId{stitch->vertices[i]} : use.high();
        sides.extras.push_back({std::min(from, to), std::max(from, to), TriangleId{use.slot / 3}, use.forward() == (from < to)});
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

/// The lines that tri-edges with made ends lie on.
void findLines(const Arrangement& arrangement, MeshEdges& edges) {
  for (const auto& ends : edges.ends) {
    const uint32_t low = ends[0].number, high = ends[1].number;
    const MadeEdge* made = arrangement.points.isMade(high) ? arrangement.findMade(low, high) : nullptr;
    edges.lines.push_back(made ? made->line : Line{low, high, false});
  }
}

}  // namespace

MeshEdges findMeshEdges(WeldedMesh& mesh, const Arrangement* arrangement) {
  MeshEdges edges;
  edges.sideEdges.assign(3 * mesh.triangles.size(), 0);
  const Sides sides = findStitchedSides(mesh, arrangement, edges);
  const auto forUses = [&](const auto& f) {
    forPlainSides(mesh, [&](VertexId low, const SideUse& use) {
      if (edges.sideEdges[use.slot] < MeshEdges::kStitched) f(low, use);
    });
    for (size_t i = 0; i < sides.extras.size(); ++i) {
      const auto& [low, high, triangle, forward] = sides.extras[i];
      f(low, SideUse{2 * high.number + forward, uint32_t(3 * mesh.triangles.size() + i)});
    }
  };

  const size_t vertices = arrangement ? arrangement->points.size() : mesh.points.size();
  std::vector<uint32_t> offsets(vertices + 1, 0);
  forUses([&](VertexId low, const SideUse&) { ++offsets[low.number + 1]; });
  for (size_t v = 0; v + 1 < offsets.size(); ++v) offsets[v + 1] += offsets[v];
  const std::unique_ptr<SideUse[]> uses(new SideUse[offsets.back()]);
  {
    std::vector<uint32_t> at(offsets.begin(), offsets.end() - 1);
    forUses([&](VertexId low, const SideUse& use) { uses[at[low.number]++] = use; });
  }
  std::vector<TriEdgeId> extraEdges(sides.extras.size());
  edges.ends.reserve(offsets.back() / 2 + 16);
  bool closed = true, oriented = true;
  for (const VertexId low : Ids<VertexId>(vertices)) {
    const std::span<SideUse> bucket(uses.get() + offsets[low.number], offsets[low.number + 1] - offsets[low.number]);
    sortItems(bucket, [](const SideUse& a, const SideUse& b) { return a.high() < b.high(); });  // slots ascend already
    for (size_t i = 0, end; i < bucket.size(); i = end) {
      int net = 0;
      for (end = i; end < bucket.size() && bucket[end].high() == bucket[i].high(); ++end) {
        const size_t slot = bucket[end].slot, plain = edges.sideEdges.size();
        (slot < plain ? edges.sideEdges[slot] : extraEdges[slot - plain].number) = uint32_t(edges.ends.size());
        net += bucket[end].forward() ? 1 : -1;
      }
      closed &= net == 0;
      oriented &= end - i != 2 || net == 0;
      edges.ends.push_back({low, bucket[i].high()});
      if (end - i > 1) dropDuplicates(mesh, bucket.subspan(i, end - i), sides);
    }
  }
  const auto firstInner = extraEdges.begin() + sides.stitchedOffsets.back();
  edges.stitched.offsets = sides.stitchedOffsets;
  edges.stitched.items.assign(extraEdges.begin(), firstInner);
  if (!arrangement) {
    mesh.closed = closed;
    mesh.oriented = oriented;
    sortItems(mesh.duplicates);
    return edges;
  }
  if (arrangement->innerEdges.size() > 0) {
    edges.inner.offsets = arrangement->innerEdges.offsets;
    edges.inner.items.assign(firstInner, extraEdges.end());
  }
  if (!arrangement->madeEdges.empty()) findLines(*arrangement, edges);
  return edges;
}

}  // namespace mandoline::detail
