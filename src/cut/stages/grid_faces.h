// Grid-faces (paper, 3.4, 4.3, 4.5, 4.6): the pieces that the surface cuts each grid-face of the stencil into, with their holes.
//
// In: Stencil, GridEdges, TriFaces. Out: GridFaces. Where a triangle lies in the grid-face, its tri-cut-face takes the piece's place.
// Ids of the faces made here follow those of TriFaces.
#pragma once

#include <vector>

#include "cut/stages/grid_edges.h"

namespace mandoline::detail {

/// A cut-edge in a grid-face with the same face on both sides: left out of that face's loops.
struct Slit {
  VertexId from, to;
  HalfFace halfFace;  ///< of that face, seen from the cell below the plane
};

struct GridFaces {
  Csr<VertexId> loops;                       ///< counter-clockwise about +axis, holes clockwise
  std::vector<uint32_t> faceLoopOffsets{0};  ///< per piece: into loops, the outer one first
  std::vector<GridFaceId> gridFaces;         ///< per piece: the grid-face it is a piece of
  Csr<HalfFace, GridFaceId> halfFaces;       ///< those that the cell below the plane sees; the cell above sees their twins
  Csr<Slit, GridFaceId> slits;

  size_t size() const { return gridFaces.size(); }
};

GridFaces cutGridFaces(const Surface& surface, const Stencil& stencil, const GridEdges& gridEdges, const TriFaces& triFaces, Run& run);

}  // namespace mandoline::detail
