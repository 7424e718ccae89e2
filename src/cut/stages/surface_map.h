// What a surface and one before it, which has moved since, have in common.
#pragma once

#include "cut/stages/brick_cut.h"
#include "mesh/prepare_again.h"

namespace mandoline::detail {

/// What vertices, tri-edges and triangles before are now. Of two surfaces whose triangles are connected alike.
class SurfaceMap {
 public:
  static constexpr VertexId kNone = KeptBricks::kNoVertex;

  /// Once the tri-edges of both are cut; `crossings`: of the surface before, known of the one now.
  SurfaceMap(const CrossingsBefore& crossings, const Surface& now, const Moved& moved);
  /// Maps the vertices in triangles, once those are clipped.
  void mapInTriangles();

  /// Whether vertices keep their order, so that what depends on it stays the same, and whether the same parts of the mesh have an inside.
  /// If not, nothing is the same.
  bool isOrdered() const { return isOrdered_; }
  /// Whether both surfaces have the same tri-edges, and nothing inside of triangles.
  bool areEdgesSame() const { return areEdgesSame_; }
  /// kNone of a vertex that lies on something that has moved.
  VertexId operator[](VertexId v) const { return vertices_[v]; }
  /// Of all vertices, at the end.
  IdVector<VertexId, VertexId> takeVertices() { return std::move(vertices_); }
  /// Whether a triangle is where it was, and has the same vertices and edges of others on it.
  bool isSame(TriangleId t) const { return same_[t] != 0; }
  /// The triangle after those, from `first` on and before `past`, of which that is so.
  TriangleId pastSame(TriangleId first, TriangleId past) const { return firstThat(0, first, past); }
  /// The same, of which it is not so.
  TriangleId pastOthers(TriangleId first, TriangleId past) const { return firstThat(1, first, past); }
  /// Past all triangles.
  TriangleId pastLast() const { return {uint32_t(same_.size())}; }
  /// Of a vertex that a brick sees.
  VertexId inBrick(VertexId v) const {
    return v.number < vertices_.size() ? vertices_[v] : VertexId{uint32_t(v.number - vertices_.size() + now_.size())};
  }

 private:
  const Prepared& meshBefore() const { return *before_.input->mesh; }
  const Prepared& meshNow() const { return *now_.input->mesh; }
  TriangleId firstThat(int isSame, TriangleId first, TriangleId past) const;
  bool hasMoved(TriangleId t) const;
  bool hasMoved(const PointKey& key) const;
  bool isSameLine(const Line& a, const Line& b) const;
  bool isSameTriangle(TriangleId t) const;
  bool haveSameOnThem(TriangleId t) const;
  bool isSameSide(uint32_t before, uint32_t now) const;
  bool areSame(std::span<const TriEdgeId> before, std::span<const TriEdgeId> now) const;
  void mapMadeVertices();
  void checkOrder();
  void mapEdges();
  void mapSameEdges(const KnownCrossings& known);
  void findSameTriangles();

  const CutVertices &before_, &now_;
  const Moved& moved_;
  IdVector<VertexId, VertexId> vertices_;
  std::vector<uint32_t> edges_;  // per tri-edge before
  IdVector<TriangleId, uint8_t> same_;
  bool isOrdered_ = true;
  bool areEdgesSame_ = false;
};

}  // namespace mandoline::detail
