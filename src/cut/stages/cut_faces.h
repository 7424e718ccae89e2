// The cut-faces of a brick (paper, 3.4): tri-cut-faces come first, then pieces of grid-faces. This is the one place that tells them apart.
#pragma once

#include <optional>

#include "cut/stages/grid_faces.h"

namespace mandoline::detail {

struct CutFaces {
  const TriFaces& tri;
  const GridFaces& grid;

  size_t size() const { return tri.size() + grid.size(); }
  bool isTri(FaceId face) const { return face.number < tri.size(); }
  /// The triangle that a face is a piece of, if any.
  std::optional<TriangleId> triangle(FaceId face) const {
    if (isTri(face)) return tri.triangles[face];
    return {};
  }
  Groups<VertexId> loops(FaceId face) const {
    if (isTri(face)) return tri.loopsOf(face);
    const size_t piece = face.number - tri.size();
    return grid.loops.groups(grid.faceLoopOffsets[piece], grid.faceLoopOffsets[piece + 1]);
  }
};

}  // namespace mandoline::detail
