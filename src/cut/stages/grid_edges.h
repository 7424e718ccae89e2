// Grid lines (paper, 4.1.2): the cut-vertices on each grid-edge of the stencil in order, and the vertex at each grid vertex.
//
// In: Stencil. Out: GridEdges; CutVertices gets the grid vertices that the surface does not pass through, in the places that the brick has
// there.
#pragma once

#include <vector>

#include "cut/stages/stencil.h"

namespace mandoline::detail {

struct GridEdges {
  Csr<VertexId, GridEdgeId> vertices;        ///< the cut-vertices inside of each grid-edge, ascending along its axis
  IdVector<GridVertexId, VertexId> corners;  ///< the cut-vertex of each grid vertex
  Predicates predicates;
};

/// Replaces `gridEdges`, whose memory is used again. Bricks write to different parts of `vertices`.
void cutGridEdges(const CutSurface& surface, BrickId brick, const Stencil& stencil, CutVertices& vertices, GridEdges& gridEdges);

}  // namespace mandoline::detail
