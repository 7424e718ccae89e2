#include "cut/stages/grid_edges.h"

namespace mandoline::detail {
namespace {

struct Placed {
  uint32_t place, vertex;  // grid-edge or grid vertex, cut-vertex
};

/// Finds all cut-vertices of the surface on grid-edges and grid vertices, each as often as a loop passes it.
void collect(const Stencil& stencil, const TriFaces& triFaces, const CutVertices& vertices, std::vector<Placed>& onEdges,
             std::vector<Placed>& onCorners) {
  const auto place = [&](const Stencil::Cell& cell, uint32_t v) {
    const Slab& slab = vertices.slabs[v];
    if (planeCount(slab) < 2) return;
    int side[3], along = -1;
    for (int d = 0; d < 3; ++d) {
      side[d] = slab[d] > cell.element[d];
      if (!onPlane(slab[d])) along = d;
    }
    if (along < 0) {
      onCorners.push_back({cell.corners[side[0] + 2 * side[1] + 4 * side[2]], v});
    } else {
      onEdges.push_back({cell.edges[cellEdge(along, side[(along + 1) % 3], side[(along + 2) % 3])], v});
    }
  };
  for (size_t c = 0; c < stencil.cells.size(); ++c) {
    for (const uint32_t f : stencil.triFacesInCell[c]) {
      if (!triFaces.touchesLine[f]) continue;
      for (const uint32_t v : triFaces.loop(f)) place(stencil.cells[c], v);
    }
  }
  for (size_t g = 0; g < stencil.faces.size(); ++g) {
    const Stencil::Cell& cell = stencil.cells[stencil.faces[g].cell];
    for (const uint32_t f : stencil.triFacesOnFace[g]) {
      for (const uint32_t v : triFaces.loop(f)) place(cell, v);
    }
    for (const FaceEdge& e : stencil.edgesOnFace[g]) {  // tri-edges in the grid-face of a triangle without a face beside it
      place(cell, e.from);
      place(cell, e.to);
    }
  }
}

}  // namespace

GridEdges cutGridEdges(const Stencil& stencil, const TriFaces& triFaces, CutVertices& vertices, Run& run) {
  constexpr uint32_t kNone = ~0u;
  std::vector<Placed> onEdges, onCorners;
  collect(stencil, triFaces, vertices, onEdges, onCorners);

  GridEdges result;
  result.corners.assign(stencil.cornerCount, kNone);
  for (const Placed& p : onCorners) {
    uint32_t& corner = result.corners[p.place];
    if (corner != kNone && corner != p.vertex) vertices.failSelfIntersectionAt(corner, p.vertex);
    corner = p.vertex;
  }
  for (const Stencil::Cell& cell : stencil.cells) {
    for (int i = 0; i < 8; ++i) {
      if (result.corners[cell.corners[i]] != kNone) continue;
      result.corners[cell.corners[i]] = uint32_t(vertices.size());
      vertices.append({cell.element[0] - 1 + 2 * (i & 1), cell.element[1] - 1 + 2 * (i >> 1 & 1), cell.element[2] - 1 + 2 * (i >> 2)});
    }
  }

  Csr<uint32_t> found = groupBy<uint32_t>(
      stencil.edgeCount, onEdges.size(), [&](size_t i) { return onEdges[i].place; }, [&](size_t i) { return onEdges[i].vertex; });
  Predicates predicates;
  result.vertices.offsets.assign(1, 0);
  result.vertices.offsets.reserve(stencil.edgeCount + 1);
  for (uint32_t e = 0; e < stencil.edgeCount; ++e) {
    if (e % 16384 == 0) run.monitor.report(e, stencil.edgeCount);
    const std::span<uint32_t> group = found[e];
    std::sort(group.begin(), group.end());
    const size_t count = size_t(std::unique(group.begin(), group.end()) - group.begin());
    if (count > 1) {
      const Slab& slab = vertices.slabs[group[0]];
      const int along = !onPlane(slab[0]) ? 0 : !onPlane(slab[1]) ? 1 : 2;
      std::sort(group.begin(), group.begin() + count,
                [&](uint32_t u, uint32_t v) { return vertices.compare(u, v, along, predicates) < 0; });
      for (size_t i = 1; i < count; ++i) {
        if (vertices.compare(group[i - 1], group[i], along, predicates) == 0) vertices.failSelfIntersectionAt(group[i - 1], group[i]);
      }
    }
    result.vertices.items.insert(result.vertices.items.end(), group.begin(), group.begin() + count);
    result.vertices.offsets.push_back(uint32_t(result.vertices.items.size()));
  }
  run.count(predicates);
  return result;
}

}  // namespace mandoline::detail
