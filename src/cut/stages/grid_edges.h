// Grid lines (paper, 4.1.2): the cut-vertices on each grid-edge of the stencil in order, and the vertex at each grid vertex.
//
// In: BrickSurface, Stencil. Out: GridEdges; the brick gets the grid vertices that the surface does not pass through as vertices of its
// own.
#pragma once

#include <vector>

#include "cut/stages/stencil.h"

namespace mandoline::detail {

struct GridEdges {
  Csr<VertexId, GridEdgeId> vertices;        ///< the cut-vertices inside of each grid-edge, ascending along its axis
  IdVector<GridVertexId, VertexId> corners;  ///< the cut-vertex of each grid vertex
  Predicates predicates;
};

/// Replaces `gridEdges`, whose memory is used again.
void cutGridEdges(BrickSurface& surface, const Stencil& stencil, GridEdges& gridEdges);

}  // namespace mandoline::detail
