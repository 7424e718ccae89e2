#include "cut/stages/grid_edges.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// Finds all cut-vertices of the surface on grid-edges and grid vertices of a brick: those of its own once and in order, after others.
class Collector {
 public:
  Collector(const BrickSurface& surface, const Stencil& stencil, GridEdges& gridEdges)
      : surface_(surface), vertices_(surface.vertices), stencil_(stencil), gridEdges_(gridEdges) {
    gridEdges.onEdges.clear();
    gridEdges.onCorners.clear();
  }

  void collect() {
    const TriFaces& triFaces = surface_.triFaces;
    for (const FaceId f : surface_.onGridLines) {
      for (const auto loop : triFaces.loopsOf(f)) {
        for (const VertexId v : loop) placeOther(v);
      }
    }
    for (size_t i = surface_.firstTriEdge; i < surface_.faceEdges.size(); ++i) {  // some lie in grid-faces that no face has
      placeOther(surface_.faceEdges[i].from);
      placeOther(surface_.faceEdges[i].to);
    }
    for (const VertexId v : surface_.seamVertices) placeOther(v);
    for (const VertexId v : vertices_.ownIds()) place(v, vertices_.slab(v));  // of each, some loop has it
  }

 private:
  void placeOther(VertexId v) {
    if (v >= vertices_.firstOwn) return;
    const Slab& slab = vertices_.slab(v);
    if (planeCount(slab) > 1) place(v, slab);
  }

  /// On a grid line that a cell of the stencil has, unless it is a seam's.
  void place(VertexId v, const Slab& slab) {
    int along = -1;
    for (int d = 0; d < 3; ++d) {
      if (!onPlane(slab[d])) along = d;
    }
    if (along < 0) return placeAtCorner(v, slab);
    const int p = (along + 1) % 3, q = (along + 2) % 3;
    for (int i = 0; i < 4; ++i) {
      const uint32_t cell = cellBelow(slab, (i & 1) << p | (i >> 1) << q);
      if (cell != Stencil::kNone) return gridEdges_.onEdges.add(stencil_.cells[{cell}].edges[size_t(cellEdge(along, i & 1, i >> 1))], v);
    }
  }
  void placeAtCorner(VertexId v, const Slab& slab) {
    for (int i = 0; i < 8; ++i) {
      const uint32_t cell = cellBelow(slab, i);
      if (cell != Stencil::kNone) return gridEdges_.onCorners.add(stencil_.cells[{cell}].corners[size_t(i)], v);
    }
  }
  /// A cell that has an element: below it along the axes that have their bits in `axes`.
  uint32_t cellBelow(const Slab& element, int axes) const {
    size_t place = stencil_.placeOf(element);
    for (size_t d = 0; d < 3; ++d) place -= axes >> d & 1 ? stencil_.steps[d] : 0;
    return stencil_.numberAt(place);
  }

  const BrickSurface& surface_;
  const CutVertices& vertices_;
  const Stencil& stencil_;
  GridEdges& gridEdges_;
};

/// The cut-vertex of each grid vertex: those where the surface passes have one already.
void setCorners(const Stencil& stencil, CutVertices& vertices, GridEdges& gridEdges) {
  constexpr VertexId kNone{~0u};
  const OnGridLines<GridVertexId>& found = gridEdges.onCorners;
  auto& corners = gridEdges.corners;
  corners.assign(stencil.cornerCount, kNone);
  for (size_t i = 0; i < found.places.size(); ++i) {
    VertexId& corner = corners[found.places[i]];
    if (corner != kNone && corner != found.vertices[i]) vertices.failSelfIntersectionAt(corner, found.vertices[i]);
    corner = found.vertices[i];
  }
  for (const Stencil::Cell& cell : stencil.cells) {
    for (int i = 0; i < 8; ++i) {
      VertexId& corner = corners[cell.corners[size_t(i)]];
      if (corner != kNone) continue;
      const Slab slab = {cell.element[0] - 1 + 2 * (i & 1), cell.element[1] - 1 + 2 * (i >> 1 & 1), cell.element[2] - 1 + 2 * (i >> 2)};
      corner = vertices.add(slab, CutVertices::kNoTriangle);
    }
  }
}

/// Puts the vertices on a grid-edge in order, each once. Gives their number.
size_t putInOrder(std::span<VertexId> onEdge, const CutVertices& vertices, Predicates& predicates) {
  sortItems(onEdge);
  const size_t count = size_t(std::unique(onEdge.begin(), onEdge.end()) - onEdge.begin());
  if (count < 2) return count;
  const Slab& slab = vertices.slab(onEdge[0]);
  const int along = !onPlane(slab[0]) ? 0 : !onPlane(slab[1]) ? 1 : 2;
  sortItems(onEdge.first(count), [&](VertexId u, VertexId v) { return vertices.compare(u, v, along, predicates) < 0; });
  for (size_t i = 1; i < count; ++i) {
    if (vertices.compare(onEdge[i - 1], onEdge[i], along, predicates) == 0) vertices.failSelfIntersectionAt(onEdge[i - 1], onEdge[i]);
  }
  return count;
}

}  // namespace

void cutGridEdges(BrickSurface& surface, const Stencil& stencil, GridEdges& gridEdges) {
  CutVertices& vertices = surface.vertices;
  Collector(surface, stencil, gridEdges).collect();
  setCorners(stencil, vertices, gridEdges);

  auto& [offsets, items] = gridEdges.vertices;
  const std::vector<VertexId>& found = gridEdges.onEdges.vertices;
  groupByPlace(
      stencil.edgeCount, gridEdges.onEdges.places, [&](uint32_t i) { return found[i]; }, gridEdges.vertices);
  uint32_t begin = 0, end = 0;  // of a grid-edge's, and what remains of those before
  for (size_t e = 0; e < stencil.edgeCount; ++e) {
    const uint32_t past = offsets[e + 1];
    size_t count = past - begin;
    if (count > 1) count = putInOrder({items.data() + begin, count}, vertices, gridEdges.predicates);
    if (end != begin) std::copy_n(items.begin() + begin, count, items.begin() + end);
    end += uint32_t(count);
    offsets[e + 1] = end;
    begin = past;
  }
  items.resize(end);
}

}  // namespace mandoline::detail
