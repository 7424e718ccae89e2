// Triangles (paper, 4.1.2 and 4.2): the axial planes that a triangle spans dice it into convex tri-cut-faces, each in one
// grid cell, or in one grid-face if the triangle lies in an axial plane.
//
// In: Surface. Out: TriFaces, and the range of CutVertices that lie in triangles. Pieces outside the grid are left out.
// After it: every hybrid edge is cut at every plane; a crossing of two hybrid edges of a triangle is one vertex; each loop runs
// counter-clockwise about its triangle's normal and holds all vertices that lie on it.
#pragma once

#include <vector>

#include "cut/stages/tri_edges.h"

namespace mandoline::detail {

/// Another triangle that a tri-cut-face is a piece of, in the same plane.
struct OtherParent {
  FaceId face;
  TriangleId triangle;
  bool sameWay;  ///< whether its normal is the face's
};

struct TriFaces {
  Csr<VertexId> loops;
  std::vector<uint32_t> faceLoopOffsets;   ///< per face its loops, the outer one first; empty if every face has one
  IdVector<FaceId, TriangleId> triangles;  ///< that it is a piece of
  IdVector<FaceId, Slab> elements;         ///< the grid cell, or the grid-face, whose even entry is then its plane
  IdVector<FaceId, uint8_t> touchesLine;   ///< whether a vertex of it lies on a grid line
  std::vector<FaceEdge> hybridEdges;       ///< cut hybrid edges that lie in a grid-face (not on a grid line)
  std::vector<OtherParent> otherParents;   ///< of faces of several triangles, ascending by face

  size_t size() const { return triangles.size(); }
  Ids<FaceId> ids() const { return triangles.ids(); }
  Groups<VertexId> loopsOf(FaceId f) const {
    return faceLoopOffsets.empty() ? loops.groups(f.number, f.number + 1)
                                   : loops.groups(faceLoopOffsets[f.number], faceLoopOffsets[f.number + 1]);
  }
};

/// Faces of triangles whose inside others reach into, not yet divided by those: see divideFaces().
struct UndividedFaces : TriFaces {
  std::vector<TriangleId> hybridTriangles;  ///< per hybrid edge
};

TriFaces cutTriangles(Surface& surface, UndividedFaces& undivided, Run& run);

}  // namespace mandoline::detail
