#include "cut/stages/grid_edges.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// A cut-vertex on a grid-edge or at a grid vertex.
template <class Place>
struct Placed {
  Place place;
  VertexId vertex;
};
struct PlacedVertices {
  std::vector<Placed<GridEdgeId>> onEdges;
  std::vector<Placed<GridVertexId>> onCorners;
};

/// Finds all cut-vertices of the surface on grid-edges and grid vertices, each as often as a loop passes it.
PlacedVertices collect(const Stencil& stencil, const TriFaces& triFaces, const CutVertices& vertices) {
  PlacedVertices placed;
  const auto place = [&](const Stencil::Cell& cell, VertexId v) {
    const Slab& slab = vertices.slabs[v];
    if (planeCount(slab) < 2) return;
    int side[3], along = -1;
    for (int d = 0; d < 3; ++d) {
      side[d] = slab[d] > cell.element[d];
      if (!onPlane(slab[d])) along = d;
    }
    if (along < 0) {
      placed.onCorners.push_back({cell.corners[side[0] + 2 * side[1] + 4 * side[2]], v});
    } else {
      placed.onEdges.push_back({cell.edges[cellEdge(along, side[(along + 1) % 3], side[(along + 2) % 3])], v});
    }
  };
  for (const GridCellId c : stencil.cells.ids()) {
    for (const FaceId f : stencil.triFacesInCell[c]) {
      if (!triFaces.touchesLine[f]) continue;
      for (const auto loop : triFaces.loopsOf(f)) {
        for (const VertexId v : loop) place(stencil.cells[c], v);
      }
    }
  }
  for (const GridFaceId g : stencil.faces.ids()) {
    const Stencil::Cell& cell = stencil.cells[stencil.faces[g].cell];
    for (const FaceId f : stencil.triFacesOnFace[g]) {
      for (const auto loop : triFaces.loopsOf(f)) {
        for (const VertexId v : loop) place(cell, v);
      }
    }
    for (const FaceEdge& e : stencil.edgesOnFace[g]) {  // tri-edges in the grid-face of a triangle without a face beside it
      place(cell, e.from);
      place(cell, e.to);
    }
  }
  return placed;
}

}  // namespace

GridEdges cutGridEdges(const Stencil& stencil, const TriFaces& triFaces, CutVertices& vertices, Run& run) {
  constexpr VertexId kNone{~0u};
  const PlacedVertices placed = collect(stencil, triFaces, vertices);
  const auto& onEdges = placed.onEdges;

  GridEdges result;
  result.corners.assign(stencil.cornerCount, kNone);
  for (const auto& p : placed.onCorners) {
    VertexId& corner = result.corners[p.place];
    if (corner != kNone && corner != p.vertex) vertices.failSelfIntersectionAt(corner, p.vertex);
    corner = p.vertex;
  }
  for (const Stencil::Cell& cell : stencil.cells) {
    for (int i = 0; i < 8; ++i) {
      VertexId& corner = result.corners[cell.corners[i]];
      if (corner != kNone) continue;
      corner =
          vertices.append({cell.element[0] - 1 + 2 * (i & 1), cell.element[1] - 1 + 2 * (i >> 1 & 1), cell.element[2] - 1 + 2 * (i >> 2)});
    }
  }

  auto found = groupBy<VertexId, GridEdgeId>(
      stencil.edgeCount, onEdges.size(), [&](size_t i) { return onEdges[i].place; }, [&](size_t i) { return onEdges[i].vertex; });
  Predicates predicates;
  result.vertices.offsets.reserve(stencil.edgeCount + 1);
  for (const GridEdgeId e : Ids<GridEdgeId>(stencil.edgeCount)) {
    if (e.number % 16384 == 0) run.monitor.report(e.number, stencil.edgeCount);
    const std::span<VertexId> group = found[e];
    sortItems(group);
    const size_t count = size_t(std::unique(group.begin(), group.end()) - group.begin());
    if (count > 1) {
      const Slab& slab = vertices.slabs[group[0]];
      const int along = !onPlane(slab[0]) ? 0 : !onPlane(slab[1]) ? 1 : 2;
      sortItems(group.first(count), [&](VertexId u, VertexId v) { return vertices.compare(u, v, along, predicates) < 0; });
      for (size_t i = 1; i < count; ++i) {
        if (vertices.compare(group[i - 1], group[i], along, predicates) == 0) vertices.failSelfIntersectionAt(group[i - 1], group[i]);
      }
    }
    result.vertices.items.insert(result.vertices.items.end(), group.begin(), group.begin() + count);
    result.vertices.endGroup();
  }
  run.count(predicates);
  return result;
}

}  // namespace mandoline::detail
