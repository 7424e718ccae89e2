#include "mesh/inspect_edges.h"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

void findComponents(const std::vector<Corners>& triangles, std::span<EdgeUse> uses, MeshInfo& info) {
  DisjointSets sets(info.triangles);
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge) sets.unite(use.triangle(), edge[0].triangle());
  });
  info.triangleComponent.assign(info.triangles, -1);
  for (uint32_t t = 0; t < info.triangles; ++t) {
    const uint32_t first = sets.find(t);
    if (hasThreeVertices(triangles[t])) info.triangleComponent[t] = first == t ? int32_t(info.components++) : info.triangleComponent[first];
  }
}

void addDefect(std::span<const EdgeUse> edge, EdgeDefect kind, MeshInfo& info) {
  info.defectVertices.insert(info.defectVertices.end(), {edge[0].low, edge[0].high});
  info.defectKind.push_back(kind);
  for (const EdgeUse& use : edge) info.defectTriangles.push_back(use.triangle());
  info.defectTriangleOffsets.push_back(uint32_t(info.defectTriangles.size()));
}

void inspectEach(std::span<EdgeUse> uses, MeshInfo& info) {
  info.closed = info.oriented = !uses.empty();
  info.componentClosed.assign(info.components, 1);
  info.componentOriented.assign(info.components, 1);
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    const size_t count = edge.size(), component = size_t(info.triangleComponent[edge[0].triangle()]);
    const size_t upwards = size_t(std::count_if(edge.begin(), edge.end(), [](const EdgeUse& use) { return use.upwards; }));
    if (count % 2 != 0) info.closed = false, info.componentClosed[component] = 0;
    if (2 * upwards != count) info.oriented = false, info.componentOriented[component] = 0;
    const bool isOpen = count == 1, isNonManifold = count > 2, isInconsistent = count == 2 && upwards != 1;
    info.openEdges += isOpen;
    info.nonManifoldEdges += isNonManifold;
    info.inconsistentEdges += isInconsistent;
    if (isOpen) addDefect(edge, EdgeDefect::open, info);
    if (isNonManifold) addDefect(edge, EdgeDefect::nonManifold, info);
    if (isInconsistent) addDefect(edge, EdgeDefect::inconsistent, info);
  });
}

void findPlaces(const MeshView& mesh, MeshInfo& info) {
  struct End {
    int32_t component;
    uint32_t vertex, defect;

    bool sameAs(const End& other) const { return component == other.component && vertex == other.vertex; }
  };
  std::vector<End> ends;
  for (uint32_t d = 0; d < info.defectCount(); ++d) {
    const int32_t component = info.triangleComponent[info.defectTriangles[info.defectTriangleOffsets[d]]];
    for (size_t i = 0; i < 2; ++i) ends.push_back({component, info.defectVertices[2 * d + i], d});
  }
  sortItems(ends, [](const End& a, const End& b) { return a.component != b.component ? a.component < b.component : a.vertex < b.vertex; });
  DisjointSets sets(info.defectCount());
  for (size_t i = 1; i < ends.size(); ++i) {
    if (ends[i].sameAs(ends[i - 1])) sets.unite(ends[i].defect, ends[i - 1].defect);
  }
  info.defectPlace.resize(info.defectCount());
  size_t places = 0;
  for (uint32_t d = 0; d < info.defectCount(); ++d) {
    const uint32_t first = sets.find(d);
    info.defectPlace[d] = first == d ? uint32_t(places++) : info.defectPlace[first];
  }
  info.placeComponent.resize(places);
  for (size_t p = 0; p < places; ++p)
    info.placeBox.insert(info.placeBox.end(), {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY});
  for (const End& end : ends) {
    const uint32_t place = info.defectPlace[end.defect];
    info.placeComponent[place] = uint32_t(end.component);
    for (size_t d = 0; d < 3; ++d) {
      double &low = info.placeBox[6 * place + d], &high = info.placeBox[6 * place + 3 + d];
      low = std::min(low, mesh.positions[3 * size_t(end.vertex) + d]);
      high = std::max(high, mesh.positions[3 * size_t(end.vertex) + d]);
    }
  }
}

}  // namespace

void inspectEdges(const MeshView& mesh, const std::vector<Corners>& triangles, MeshInfo& info) {
  std::vector<EdgeUse> uses = edgeUses(triangles, mesh.vertexCount());
  findComponents(triangles, uses, info);
  inspectEach(uses, info);
  findPlaces(mesh, info);
}

}  // namespace mandoline::detail
