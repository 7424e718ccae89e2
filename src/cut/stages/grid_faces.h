// Grid-faces (paper, 3.4, 4.3, 4.5, 4.6): the pieces that the surface cuts each grid-face of the stencil into, with their holes.
//
// In: BrickSurface, Stencil, GridEdges. Out: GridFaces. Where a triangle lies in the grid-face, its tri-cut-face takes the piece's place.
// Ids of the faces made here follow those of TriFaces: they are numbers in the brick.
#pragma once

#include <optional>
#include <vector>

#include "cut/stages/grid_edges.h"
#include "cut/stages/planar_graph.h"

namespace mandoline::detail {

/// A cut-edge in a grid-face with the same face on both sides: left out of that face's loops.
struct Slit {
  VertexId from, to;
  HalfFace halfFace;  ///< of that face, seen from the cell below the plane
};

/// How a grid-face was cut.
enum class GridFaceKind : uint8_t { whole, chains, graph };

struct GridFaces {
  Csr<VertexId> loops;                       ///< counter-clockwise about +axis, holes clockwise
  std::vector<uint32_t> faceLoopOffsets{0};  ///< per piece: into loops, the outer one first
  std::vector<GridFaceId> gridFaces;         ///< per piece: the grid-face it is a piece of
  Csr<HalfFace, GridFaceId> halfFaces;       ///< those that the cell below the plane sees; the cell above sees their twins
  Csr<Slit, GridFaceId> slits;
  IdVector<GridFaceId, GridFaceKind> kinds;
  /// Of those that chains cut, the pieces beside edges, counted in the grid-face: first where each of its four sides begins, and where the
  /// last ends; then the piece inside of each edge of the outline; then those left and right of each of the stencil's edgesOnFace.
  Csr<uint32_t, GridFaceId> beside;

  size_t size() const { return gridFaces.size(); }
};

/// What cutting grid-faces needs room for; the same for all bricks of a thread.
struct GridFaceScratch {
  Predicates predicates;
  PlanarGraph graph;
  Chains chains;
  std::vector<VertexId> outline, loop;
  std::array<uint32_t, 5> sides;                              ///< where they begin in the outline, and where the last ends
  IdVector<PlanarGraph::Face, std::optional<HalfFace>> seen;  ///< per face of the graph: what the cell below the plane sees
  bool onlyGraph = false;                                     ///< without one_chain.h and chains.h
};

/// Replaces `faces`, whose memory is used again.
void cutGridFaces(const BrickSurface& surface, const Stencil& stencil, const GridEdges& gridEdges, GridFaceScratch& scratch,
                  GridFaces& faces);

}  // namespace mandoline::detail
