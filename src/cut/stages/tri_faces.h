// Stage 3, triangles (paper, 4.1.2 and 4.2): dices every triangle by the axial planes that it spans into convex tri-cut-faces, each in one
// grid cell, or in one grid-face if the triangle lies in an axial plane.
//
// In: Surface. Out: TriFaces, and the range of CutVertices that lie in triangles. Pieces outside the grid are left out.
// After it: every hybrid edge is cut at every plane; a crossing of two hybrid edges of a triangle is one vertex; each loop runs
// counter-clockwise about its triangle's normal and holds all vertices that lie on it.
#pragma once

#include <vector>

#include "cut/stages/tri_edges.h"

namespace mandoline::detail {

struct TriFaces {
  std::vector<uint32_t> loopOffsets{0}, loopVertices;  ///< one loop per face
  std::vector<uint32_t> triangles;                     ///< per face
  std::vector<Slab> elements;                          ///< per face: the grid cell, or the grid-face, whose even entry is then its plane
  std::vector<uint8_t> touchesLine;                    ///< per face: whether a vertex of it lies on a grid line
  std::vector<FaceEdge> hybridEdges;                   ///< cut hybrid edges that lie in a grid-face (not on a grid line)

  size_t size() const { return triangles.size(); }
  std::span<const uint32_t> loop(size_t f) const { return {loopVertices.data() + loopOffsets[f], loopOffsets[f + 1] - loopOffsets[f]}; }
};

TriFaces cutTriangles(Surface& surface, Run& run);

}  // namespace mandoline::detail
