// Grid lines (paper, 4.1.2): the cut-vertices on each grid-edge of the stencil in order, and the vertex at each grid vertex.
//
// In: Stencil, TriFaces. Out: GridEdges; CutVertices gets the grid vertices that the surface does not pass through.
#pragma once

#include <vector>

#include "cut/stages/stencil.h"

namespace mandoline::detail {

struct GridEdges {
  Csr<VertexId, GridEdgeId> vertices;        ///< the cut-vertices inside of each grid-edge, ascending along its axis
  IdVector<GridVertexId, VertexId> corners;  ///< the cut-vertex of each grid vertex
};

GridEdges cutGridEdges(const Stencil& stencil, const TriFaces& triFaces, CutVertices& vertices, Run& run);

}  // namespace mandoline::detail
