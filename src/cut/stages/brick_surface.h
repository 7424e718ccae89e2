// The surface in a brick (paper, 4.1.2 and 4.2): the axial planes that a triangle spans dice it into convex tri-cut-faces.
//
// In: SurfaceParts. Out: BrickSurface, and the grid cells that it touches, marked in Bricks.
// After it: every hybrid edge is cut at every plane; a crossing of two hybrid edges of a triangle is one vertex.
#pragma once

#include "cut/stages/bricks.h"
#include "cut/stages/polygon.h"

namespace mandoline::detail {

/// All of it that the later stages see. Ids of vertices from vertices.firstOwn on and of faces are numbers in the brick.
struct BrickSurface {
  explicit BrickSurface(const Surface& surface) : input(surface.input), vertices(CutVertices::ofBrick(surface.vertices)) {}

  const Input& input;
  CutVertices vertices;
  TriFaces triFaces;                 ///< ascending by triangle, those of divided triangles last
  std::vector<FaceId> specialFaces;  ///< see PartedCell; ascending
  std::vector<FaceId> onGridLines;   ///< those with a vertex of the surface on a grid line, ascending
  std::vector<FaceEdge> faceEdges;   ///< cut-edges that lie in a grid-face: in each by triangle, those of tri-edges last. Counter-clockwise
                                     ///< about its axis, the front of a hybrid edge's triangle is on the left
  size_t firstTriEdge = 0;           ///< of faceEdges: the first that is of a tri-edge
  std::span<const VertexId> seamVertices;  ///< see Bricks
  Predicates predicates;
  bool onlySweep = false;  ///< for tests: how triangles are diced, see Dicer

  const MeshEdges& edges() const { return input.mesh->edges; }
};

/// Replaces `brickSurface`, whose memory is used again.
void cutBrickSurface(const Surface& surface, const SurfaceParts& parts, BrickId brick, Bricks& bricks, BrickSurface& brickSurface);

}  // namespace mandoline::detail
