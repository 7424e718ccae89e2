// Tri-edges (paper, 3.3 and 4.1.1): their crossings with the axial planes, in order.
//
// In: Input. Out: the first two ranges of CutVertices, and the pieces of tri-edges that lie in grid-faces.
// After it: crossings of several planes at one point are one vertex; the slabs of every crossing are complete and exact.
#pragma once

#include <vector>

#include "base/csr.h"
#include "cut/predicates/cut_vertices.h"
#include "mesh/prepare_again.h"

namespace mandoline::detail {

/// A piece of a cut-edge's line that lies in one grid-face: what the planar graph of that grid-face is made of.
struct FaceEdge {
  Slab element;  ///< the grid-face: one entry is even
  VertexId from, to;
};

/// What processes that cut together leave to others: all of the surface but the triangles that a process cuts, and their edges.
struct SurfaceHere {
  std::vector<uint8_t> triangles, edges;  ///< per triangle and tri-edge whether it is cut here; empty: all are

  bool has(TriangleId t) const { return triangles.empty() || triangles[t.number] != 0; }
  bool has(TriEdgeId e) const { return edges.empty() || edges[e.number] != 0; }
};

/// The surface and the cut-vertices on it. They refer to its other members, so it can't be moved or copied.
struct Surface {
  Input input;
  SurfaceHere here;
  CutVertices vertices;
  std::vector<TriEdgeId> inPlane;          ///< tri-edges that lie in an axial plane, ascending
  std::vector<FaceEdge> edgesInPlane;      ///< pieces of them that lie in a grid-face
  bool isPlain = false;                    ///< no vertex of the mesh lies on a plane, and those on tri-edges lie on one each
  IdVector<TriangleId, uint8_t> unpaired;  ///< whether it has a tri-edge that is not of two triangles; may be empty if none has

  Surface() = default;
  Surface(const Surface&) = delete;

  const MeshEdges& edges() const { return input.mesh->edges; }
};

/// Crossings that are known beforehand. An interface: other cuts don't link what finds them.
class KnownCrossings {
 public:
  /// The edge after those, from `first` on and before `past`, whose crossings are known.
  virtual TriEdgeId pastKnown(TriEdgeId first, TriEdgeId past) const = 0;
  /// Whose they are, under the same ids of edges.
  virtual const Surface& surface() const = 0;

 protected:
  ~KnownCrossings() = default;
};

/// The crossings of a surface before whose triangles were connected alike.
class CrossingsBefore final : public KnownCrossings {
 public:
  /// None where triangles meet in one of both. The edges before may have been moved into those now.
  CrossingsBefore(const Surface& before, const Surface& now, const Moved& moved);

  TriEdgeId pastKnown(TriEdgeId first, TriEdgeId past) const override;
  const Surface& surface() const override { return before_; }

 private:
  const Surface& before_;
  const bool areKnown_;
  IdVector<TriEdgeId, uint8_t> haveMoved_;  // if they are known, otherwise
};

/// How many ids the crossings of a tri-edge have, by the slabs of its ends.
uint32_t crossingIds(const Slab& low, const Slab& high);
/// Throws Failure{meshTooLarge} if these are too many for their ids.
void requireFewVertices(uint64_t count);

/// Fills in the rest of the surface from `surface.input`. `known` may be null.
void cutTriEdges(Surface& surface, Run& run, const KnownCrossings* known = nullptr);

}  // namespace mandoline::detail
