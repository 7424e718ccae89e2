#include "cut/stages/changed_bricks.h"

#include <algorithm>
#include <cstring>

namespace mandoline::detail {

ChangedBricks::ChangedBricks(const Surface& surfaceBefore, const ClippedTriangles& clippedBefore, const Bricks& before,
                             const SurfaceMap& map)
    : surfaceBefore_(surfaceBefore), before_(before), map_(map) {
  for (const BrickId b : before.ids()) {
    const std::vector<TriangleId>& triangles = before.triangles[b];
    if (!std::all_of(triangles.begin(), triangles.end(), [&](TriangleId t) { return map.isSame(t); })) keys_.add(before.keys[b]);
  }
  for (size_t i = 0; i < clippedBefore.seamTriangles.size(); ++i) {
    if (!map.isSame(clippedBefore.seamTriangles[i])) addAround(surfaceBefore.vertices.slab(clippedBefore.seamVertices[i]));
  }
}

void ChangedBricks::addOf(const ClippedTriangles& moved, const Surface& now) {
  for (const ClippedTriangles::Part& part : moved.parts) keys_.add(part.brick);
  for (const FaceEdge& edge : moved.hybridEdges) addAround(edge.element);
  for (const VertexId v : moved.seamVertices) addAround(now.vertices.slab(v));
  addInPlane(now);
}

std::vector<TriangleId> ChangedBricks::trianglesAtRest() const {
  IdVector<TriangleId, uint8_t> areListed(map_.pastLast().number, 0);
  size_t count = 0;
  for (const BrickId b : before_.ids()) {
    if (!has(before_.keys[b])) continue;
    for (const TriangleId t : before_.triangles[b]) {
      const bool isNew = map_.isSame(t) && !areListed[t];
      areListed[t] |= uint8_t(isNew);
      count += isNew;
    }
  }
  std::vector<TriangleId> list;
  list.reserve(count);
  for (uint32_t t = 0; list.size() < count; ++t) {
    t = uint32_t(static_cast<const uint8_t*>(std::memchr(areListed.data() + t, 1, areListed.size() - t)) - areListed.data());
    list.push_back({t});
  }
  return list;
}

void ChangedBricks::addAround(const Slab& element) {
  before_.grid.forBricks(element, [&](const Slab& cell) { keys_.add(before_.grid.keyOf(cell)); });
}

void ChangedBricks::addSeamVertex(const Slab& slab) {
  if (planeCount(slab) > 1 && before_.grid.isOnSeam(slab)) addAround(slab);
}

void ChangedBricks::addEnds(const FaceEdge& edge, const CutVertices& vertices) {
  addAround(edge.element);
  addSeamVertex(vertices.slab(edge.from));
  addSeamVertex(vertices.slab(edge.to));
}

/// Both lists ascend by tri-edge; of those that have not moved they have the same.
void ChangedBricks::addInPlane(const Surface& now) {
  auto next = now.edgesInPlane.begin();
  for (const FaceEdge& before : surfaceBefore_.edgesInPlane) {
    const FaceEdge same{before.element, map_[before.from], map_[before.to]};
    if (same.from == SurfaceMap::kNone || same.to == SurfaceMap::kNone) {
      addEnds(before, surfaceBefore_.vertices);
      continue;
    }
    const auto isSame = [&](const FaceEdge& edge) { return edge.element == same.element && edge.from == same.from && edge.to == same.to; };
    for (; next != now.edgesInPlane.end() && !isSame(*next); ++next) addEnds(*next, now.vertices);
    if (next != now.edgesInPlane.end()) ++next;
  }
  for (; next != now.edgesInPlane.end(); ++next) addEnds(*next, now.vertices);
}

void listTriangles(const ClippedTriangles& clipped, Bricks& bricks) {
  bricks.triangles.resize(bricks.size());
  for (const BrickId b : bricks.ids()) {
    std::vector<TriangleId>& list = bricks.triangles[b];
    list.reserve(bricks.parts[b].size());
    for (const uint32_t part : bricks.parts[b]) {
      const TriangleId triangle = clipped.parts[part].triangle;
      if (list.empty() || list.back() != triangle) list.push_back(triangle);
    }
  }
}

}  // namespace mandoline::detail
