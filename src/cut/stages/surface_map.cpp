#include "cut/stages/surface_map.h"

#include <algorithm>
#include <cstring>

#include "base/sort.h"

namespace mandoline::detail {
namespace {

constexpr uint32_t kNoEdge = ~0u;

}  // namespace

SurfaceMap::SurfaceMap(const CrossingsBefore& crossings, const Surface& now, const Moved& moved)
    : before_(crossings.surface().vertices), now_(now.vertices), moved_(moved), vertices_(before_.size(), kNone) {
  for (const VertexId v : moved.ids()) {
    if (!moved[v]) vertices_[v] = v;
  }
  if (meshBefore().hasIntersections() && meshNow().hasIntersections()) mapMadeVertices();
  isOrdered_ = meshBefore().parts.kinds == meshNow().parts.kinds;
  checkOrder();
  if (!isOrdered_) return;
  areEdgesSame_ = !meshBefore().hasIntersections() && !meshNow().hasIntersections();
  areEdgesSame_ ? mapSameEdges(crossings) : mapEdges();
  findSameTriangles();
}

bool SurfaceMap::hasMoved(TriangleId t) const { return detail::hasMoved(moved_, meshBefore().triangles[t.number]); }

/// Whether any of what meets at a point has.
bool SurfaceMap::hasMoved(const PointKey& key) const {
  const auto hasVertexMoved = [&](size_t i) { return moved_[{key.ids[i]}] != 0; };
  const auto hasTriangleMoved = [&](size_t i) { return hasMoved(TriangleId{key.ids[i]}); };
  switch (key.kind) {
    case PointKey::Kind::vertex:
      return hasVertexMoved(0);
    case PointKey::Kind::edgeTriangle:
      return hasVertexMoved(0) || hasVertexMoved(1) || hasTriangleMoved(2);
    case PointKey::Kind::edgeEdge:
      return hasVertexMoved(0) || hasVertexMoved(1) || hasVertexMoved(2) || hasVertexMoved(3);
    case PointKey::Kind::triangles:
      break;
  }
  return hasTriangleMoved(0) || hasTriangleMoved(1) || hasTriangleMoved(2);
}

void SurfaceMap::mapMadeVertices() {
  const MeshPoints &before = meshBefore().arrangement->points, &now = meshNow().arrangement->points;
  std::vector<std::pair<PointKey, uint32_t>> known;
  for (uint32_t v = now.firstMade(); v < now.size(); ++v) known.push_back({now.key(v), v});
  sortItems(known);
  for (uint32_t v = before.firstMade(); v < before.size(); ++v) {
    const PointKey& key = before.key(v);
    if (hasMoved(key)) continue;
    const auto at = std::lower_bound(known.begin(), known.end(), key, [](const auto& entry, const PointKey& k) { return entry.first < k; });
    if (at != known.end() && at->first == key) vertices_[{v}] = {at->second};
  }
}

void SurfaceMap::checkOrder() {
  VertexId last{0};
  for (const VertexId v : Ids<VertexId>(meshBefore().points.size())) {
    if (vertices_[v] == kNone) continue;
    isOrdered_ &= last <= vertices_[v];
    last = vertices_[v];
  }
}

bool SurfaceMap::isSameLine(const Line& a, const Line& b) const {
  if (a.a != b.a || a.b != b.b || a.ofPlanes != b.ofPlanes) return false;
  if (a.ofPlanes) return !hasMoved(TriangleId{a.a}) && !hasMoved(TriangleId{a.b});
  return !moved_[{a.a}] && !moved_[{a.b}];
}

/// Both lists ascend.
void SurfaceMap::mapEdges() {
  const MeshEdges &before = *before_.edges, &now = *now_.edges;
  edges_.assign(before.ends.size(), kNoEdge);
  TriEdgeId at{0};
  for (const TriEdgeId e : before.ends.ids()) {
    const std::array<VertexId, 2> ends = {vertices_[before.ends[e][0]], vertices_[before.ends[e][1]]};
    if (ends[0] == kNone || ends[1] == kNone) continue;
    while (at.number < now.ends.size() && now.ends[at] < ends) ++at.number;
    if (at.number == now.ends.size() || now.ends[at] != ends || !isSameLine(before.line(e), now.line(at))) continue;
    edges_[e.number] = at.number;
    VertexId crossing = *now_.crossings(at).begin();
    for (const VertexId v : before_.crossings(e)) vertices_[v] = VertexId{crossing.number++};
  }
}

void SurfaceMap::mapSameEdges(const KnownCrossings& known) {
  const TriEdgeId past{uint32_t(now_.edges->ends.size())};
  for (TriEdgeId e{0}; e < past; ++e.number) {
    const TriEdgeId pastKnown = known.pastKnown(e, past);
    VertexId crossing = now_.crossingOffsets[e.number];
    for (const VertexId v : Ids<VertexId>(before_.crossingOffsets[e.number], before_.crossingOffsets[pastKnown.number]))
      vertices_[v] = VertexId{crossing.number++};
    e = pastKnown;  // which is not known
  }
}

bool SurfaceMap::areSame(std::span<const TriEdgeId> before, std::span<const TriEdgeId> now) const {
  return std::equal(before.begin(), before.end(), now.begin(), now.end(),
                    [&](TriEdgeId a, TriEdgeId b) { return edges_[a.number] == b.number; });
}

/// As in MeshEdges::sideEdges.
bool SurfaceMap::isSameSide(uint32_t before, uint32_t now) const {
  const uint32_t stitched = MeshEdges::kStitched;
  if (before < stitched && now < stitched) return edges_[before] == now;
  return before >= stitched && now >= stitched && areSame(before_.edges->stitched[before - stitched], now_.edges->stitched[now - stitched]);
}

bool SurfaceMap::isSameTriangle(TriangleId t) const {
  if (hasMoved(t) || !meshNow().kept(t)) return false;
  for (size_t side = 3 * size_t(t.number); side < 3 * size_t(t.number) + 3; ++side) {
    if (!isSameSide(before_.edges->sideEdges[side], now_.edges->sideEdges[side])) return false;
  }
  return haveSameOnThem(t);
}

/// Whether a triangle has the same of others on it.
bool SurfaceMap::haveSameOnThem(TriangleId t) const {
  if (!areSame(before_.edges->innerOf(t), now_.edges->innerOf(t))) return false;
  const auto listOf = [&](const Prepared& mesh, Csr<uint32_t> Arrangement::*lists) {
    return mesh.hasIntersections() ? (mesh.arrangement.get()->*lists)[t.number] : std::span<const uint32_t>();
  };
  const auto haveSame = [&](Csr<uint32_t> Arrangement::*lists, const auto& isSame) {
    const auto before = listOf(meshBefore(), lists), now = listOf(meshNow(), lists);
    return std::equal(before.begin(), before.end(), now.begin(), now.end(), isSame);
  };
  return haveSame(&Arrangement::innerVertices, [&](uint32_t a, uint32_t b) { return vertices_[{a}] == VertexId{b}; }) &&
         haveSame(&Arrangement::overlaps, [&](uint32_t a, uint32_t b) { return a == b && !hasMoved(TriangleId{a}); });
}

void SurfaceMap::findSameTriangles() {
  same_.resize(meshBefore().triangles.size());
  if (!areEdgesSame_) {
    for (const TriangleId t : same_.ids()) same_[t] = isSameTriangle(t);
    return;
  }
  const auto* triangles = meshBefore().triangles.data();
  const TriangleState* states = meshNow().states.data();
  const uint8_t* moved = moved_.data();
  for (size_t t = 0; t < same_.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    same_.data()[t] = uint8_t(!(moved[a] | moved[b] | moved[c]) & (states[t] == TriangleState::kept));
  }
}

TriangleId SurfaceMap::firstThat(int isSame, TriangleId first, TriangleId past) const {
  if (first == past) return past;
  const uint8_t* const same = same_.data();
  const void* const found = std::memchr(same + first.number, isSame, past.number - first.number);
  return found ? TriangleId{uint32_t(static_cast<const uint8_t*>(found) - same)} : past;
}

/// Both lists ascend by triangle.
void SurfaceMap::mapInTriangles() {
  if (!isOrdered_) return;
  const std::vector<TriangleId>&before = before_.parentTriangles, &now = now_.parentTriangles;
  size_t at = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    if (!isSame(before[i])) continue;
    if (i == 0 || before[i] != before[i - 1]) {
      while (now[at] < before[i]) ++at;
    }
    vertices_[{uint32_t(before_.firstInTriangle.number + i)}] = VertexId{uint32_t(now_.firstInTriangle.number + at++)};
  }
}

}  // namespace mandoline::detail
