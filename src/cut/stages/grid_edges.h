// Grid lines (paper, 4.1.2): the cut-vertices on each grid-edge of the stencil in order, and the vertex at each grid vertex.
//
// In: BrickSurface, Stencil. Out: GridEdges; the brick gets the grid vertices that the surface does not pass through as vertices of its
// own.
#pragma once

#include <vector>

#include "cut/stages/stencil.h"

namespace mandoline::detail {

/// A cut-vertex on a grid-edge or at a grid vertex.
template <class Place>
struct OnGridLines {
  std::vector<Place> places;
  std::vector<VertexId> vertices;

  void clear() {
    places.clear();
    vertices.clear();
  }
  void add(Place place, VertexId vertex) {
    places.push_back(place);
    vertices.push_back(vertex);
  }
};

struct GridEdges {
  Csr<VertexId, GridEdgeId> vertices;        ///< the cut-vertices inside of each grid-edge, ascending along its axis
  IdVector<GridVertexId, VertexId> corners;  ///< the cut-vertex of each grid vertex
  Predicates predicates;

  // Scratch: what the surface passes, some of it several times.
  OnGridLines<GridEdgeId> onEdges;
  OnGridLines<GridVertexId> onCorners;
};

/// Replaces `gridEdges`, whose memory is used again.
void cutGridEdges(BrickSurface& surface, const Stencil& stencil, GridEdges& gridEdges);

}  // namespace mandoline::detail
