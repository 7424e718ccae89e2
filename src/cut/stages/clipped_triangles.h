// Triangles, clipped by the planes between bricks: each brick gets those that lie in it whole, and pieces of others.
//
// In: Surface. Out: ClippedTriangles, and the range of CutVertices that lie in triangles and on these planes. Triangles whose inside others
// reach into are diced here as a whole, and divided by those next: see divided_faces.h. What lies outside the grid is left out.
// After it: a piece has all vertices on its sides; what two pieces have in common is the same to both.
#pragma once

#include "cut/stages/brick_grid.h"
#include "cut/stages/polygon.h"
#include "cut/stages/tri_faces.h"

namespace mandoline::detail {

struct ClippedTriangles {
  static constexpr uint32_t kWhole = ~0u;

  /// What a brick gets of a triangle.
  struct Part {
    uint64_t brick;  ///< its key
    TriangleId triangle;
    uint32_t piece;  ///< or kWhole
  };
  std::vector<Part> parts;  ///< ascending by triangle
  Csr<Corner> pieces;
  std::vector<FaceEdge> hybridEdges;        ///< cut hybrid edges in the planes that clip
  std::vector<TriangleId> hybridTriangles;  ///< per hybrid edge, ascending
  std::vector<VertexId> seamVertices;       ///< of parts, on grid lines that several bricks have; some repeatedly
  std::vector<TriangleId> seamTriangles;    ///< per seam vertex, ascending
  UndividedFaces undivided;
};

/// What is known of some triangles beforehand. An interface: other cuts don't link what finds it.
class KnownClips {
 public:
  /// The triangle after those, from `first` on and before `past`, that are known.
  virtual TriangleId pastKnown(TriangleId first, TriangleId past) const = 0;
  /// Adds them to those of all others, and their vertices.
  virtual void addTo(ClippedTriangles& others, CutVertices& vertices) = 0;

 protected:
  ~KnownClips() = default;
};

/// `known` may be null.
ClippedTriangles clipTriangles(Surface& surface, const BrickGrid& bricks, Run& run, KnownClips* known = nullptr);

}  // namespace mandoline::detail
