#include "cut/stages/grid_edges.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// A cut-vertex on a grid-edge or at a grid vertex.
template <class Place>
struct LineVertex {
  Place place;
  VertexId vertex;
};

/// Finds all cut-vertices of the surface on grid-edges and grid vertices of a brick, each as often as a loop passes it.
class Collector {
 public:
  Collector(const BrickSurface& surface, const Stencil& stencil)
      : triFaces_(surface.triFaces), vertices_(surface.vertices), stencil_(stencil) {}

  std::vector<LineVertex<GridEdgeId>> onEdges;
  std::vector<LineVertex<GridVertexId>> onCorners;

  void collect(std::span<const VertexId> seamVertices) {
    for (const GridCellId c : stencil_.cells.ids()) {
      for (const FaceId f : stencil_.triFacesInCell[c]) {
        if (triFaces_.touchesLine[f]) placeLoops(stencil_.cells[c], f);
      }
    }
    for (const GridFaceId g : stencil_.faces.ids()) {
      const Stencil::Cell& cell = stencil_.cells[stencil_.faces[g].cell];
      for (const FaceId f : stencil_.triFacesOnFace[g]) placeLoops(cell, f);
      for (const FaceEdge& e : stencil_.edgesOnFace[g]) {  // tri-edges in the grid-face of a triangle without a face beside it
        place(cell, e.from);
        place(cell, e.to);
      }
    }
    for (const VertexId v : seamVertices) {
      if (const auto cell = stencil_.cellBeside(vertices_.slab(v))) place(stencil_.cells[*cell], v);
    }
  }

 private:
  void placeLoops(const Stencil::Cell& cell, FaceId f) {
    for (const auto loop : triFaces_.loopsOf(f)) {
      for (const VertexId v : loop) place(cell, v);
    }
  }

  void place(const Stencil::Cell& cell, VertexId v) {
    const Slab& slab = vertices_.slab(v);
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
  }

  const TriFaces& triFaces_;
  const CutVertices& vertices_;
  const Stencil& stencil_;
};

/// The cut-vertex of each grid vertex: those where the surface passes have one already.
void setCorners(const Collector& found, const Stencil& stencil, CutVertices& vertices, GridEdges& gridEdges) {
  constexpr VertexId kNone{~0u};
  auto& corners = gridEdges.corners;
  corners.assign(stencil.cornerCount, kNone);
  for (const auto& [place, vertex] : found.onCorners) {
    if (corners[place] != kNone && corners[place] != vertex) vertices.failSelfIntersectionAt(corners[place], vertex);
    corners[place] = vertex;
  }
  for (const Stencil::Cell& cell : stencil.cells) {
    for (int i = 0; i < 8; ++i) {
      VertexId& corner = corners[cell.corners[i]];
      if (corner != kNone) continue;
      const Slab slab = {cell.element[0] - 1 + 2 * (i & 1), cell.element[1] - 1 + 2 * (i >> 1 & 1), cell.element[2] - 1 + 2 * (i >> 2)};
      corner = vertices.add(slab, CutVertices::kNoTriangle);
    }
  }
}

}  // namespace

void cutGridEdges(BrickSurface& surface, const Stencil& stencil, GridEdges& gridEdges) {
  CutVertices& vertices = surface.vertices;
  Collector found(surface, stencil);
  found.collect(surface.seamVertices);
  setCorners(found, stencil, vertices, gridEdges);

  const auto& onEdges = found.onEdges;
  auto groups = groupBy<VertexId, GridEdgeId>(
      stencil.edgeCount, onEdges.size(), [&](size_t i) { return onEdges[i].place; }, [&](size_t i) { return onEdges[i].vertex; });
  Predicates& predicates = gridEdges.predicates;
  gridEdges.vertices.clear();
  for (const GridEdgeId e : Ids<GridEdgeId>(stencil.edgeCount)) {
    const std::span<VertexId> group = groups[e];
    sortItems(group);
    const size_t count = size_t(std::unique(group.begin(), group.end()) - group.begin());
    if (count > 1) {
      const Slab& slab = vertices.slab(group[0]);
      const int along = !onPlane(slab[0]) ? 0 : !onPlane(slab[1]) ? 1 : 2;
      sortItems(group.first(count), [&](VertexId u, VertexId v) { return vertices.compare(u, v, along, predicates) < 0; });
      for (size_t i = 1; i < count; ++i) {
        if (vertices.compare(group[i - 1], group[i], along, predicates) == 0) vertices.failSelfIntersectionAt(group[i - 1], group[i]);
      }
    }
    gridEdges.vertices.items.insert(gridEdges.vertices.items.end(), group.begin(), group.begin() + count);
    gridEdges.vertices.endGroup();
  }
}

}  // namespace mandoline::detail
