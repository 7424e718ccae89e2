// The surface in a brick (paper, 4.1.2 and 4.2): the axial planes that a triangle spans dice it into convex tri-cut-faces.
//
// In: SurfaceParts. Out: BrickSurface, and the grid cells that it touches, marked in Bricks.
// After it: every hybrid edge is cut at every plane; a crossing of two hybrid edges of a triangle is one vertex.
#pragma once

#include "cut/stages/bricks.h"
#include "cut/stages/polygon.h"

namespace mandoline::detail {

/// Triangles of a brick that each lie inside of a grid cell: which of them are connected, tri-edge by tri-edge, to some that leave the
/// cell? Each brick of a surface is asked once, since what is known of tri-edges stays.
class InnerTriangles {
 public:
  /// Begins with another brick of the same surface.
  void begin(const MeshEdges& edges) {
    edges_ = &edges;
    items_.clear();
    isReached_.resize(edges.ends.size());
  }
  /// One that lies inside of a cell and touches none of its grid-faces, without stitched sides.
  void add(FaceId face, TriangleId triangle) { items_.push_back({face, triangle}); }
  /// One that leaves a cell.
  void addOther(TriangleId triangle);
  /// Appends the faces of those that are connected to none that leaves its cell.
  void listFloating(std::vector<FaceId>& faces);

 private:
  struct Item {
    FaceId face;
    TriangleId triangle;
  };
  const uint32_t* sidesOf(TriangleId triangle) const { return edges_->sideEdges.data() + 3 * size_t(triangle.number); }
  void dropNear();
  void dropConnected();

  const MeshEdges* edges_ = nullptr;
  std::vector<Item> items_;  // those that are left
  /// Whether a tri-edge inside of a cell, which one brick alone has, is of a triangle that leaves the cell or is connected to such.
  IdVector<TriEdgeId, uint8_t> isReached_;
};

/// All of it that the later stages see. Ids of vertices from vertices.firstOwn on and of faces are numbers in the brick.
struct BrickSurface {
  explicit BrickSurface(const Surface& surface) : input(surface.input), vertices(CutVertices::ofBrick(surface.vertices)) {}

  const Input& input;
  CutVertices vertices;
  TriFaces triFaces;                 ///< ascending by triangle, those of divided triangles last
  std::vector<FaceId> specialFaces;  ///< see PartedCell
  std::vector<FaceId> onGridLines;   ///< those with a vertex of the surface on a grid line, ascending
  std::vector<FaceEdge> faceEdges;   ///< cut-edges that lie in a grid-face: in each by triangle, those of tri-edges last. Counter-clockwise
                                     ///< about its axis, the front of a hybrid edge's triangle is on the left
  size_t firstTriEdge = 0;           ///< of faceEdges: the first that is of a tri-edge
  std::span<const VertexId> seamVertices;  ///< see Bricks
  Predicates predicates;
  InnerTriangles inner;
  bool onlySweep = false;  ///< for tests: how triangles are diced, see Dicer

  const MeshEdges& edges() const { return input.mesh->edges; }
};

/// Replaces `brickSurface`, whose memory is used again.
void cutBrickSurface(const Surface& surface, const SurfaceParts& parts, BrickId brick, Bricks& bricks, BrickSurface& brickSurface);

}  // namespace mandoline::detail
