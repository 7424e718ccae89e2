// All cut-faces of a cut (paper, 3.4): tri-cut-faces come first, then pieces of grid-faces. This is the one place that tells them apart.
#pragma once

#include "cut/stages/grid_faces.h"

namespace mandoline::detail {

struct CutFaces {
  TriFaces tri;
  GridFaces grid;

  size_t size() const { return tri.size() + grid.size(); }
  bool isTri(FaceId face) const { return face.number < tri.size(); }
  /// The triangle that a face is a piece of, or -1.
  int64_t triangle(FaceId face) const { return isTri(face) ? int64_t(tri.triangles[face.number]) : -1; }
  Loops loops(FaceId face) const {
    if (isTri(face)) return {tri.loopOffsets.data() + face.number, 1, tri.loopVertices.data()};
    const size_t piece = face.number - tri.size(), first = grid.faceLoopOffsets[piece];
    return {grid.loopOffsets.data() + first, grid.faceLoopOffsets[piece + 1] - first, grid.loopVertices.data()};
  }
};

}  // namespace mandoline::detail
