// Faces as the simple polygons that file formats want, without holes and without slits.
#pragma once

#include "base/shared.h"
#include "mandoline/triangulate.h"

namespace mandoline::detail {

/// A face that is one simple loop stays a polygon; any other is split into its triangles. Both cells at a face see the same polygons.
class Polygons {
 public:
  MANDOLINE_SHARED explicit Polygons(const CutMesh& cutMesh);

  /// Calls visit(std::span<const uint32_t> vertices) for each polygon of a face, counter-clockwise about the face's normal.
  template <class Visit>
  void forEach(size_t face, const Visit& visit) const {
    if (!split_[face]) return visit(cutMesh_.loop(cutMesh_.faceLoopOffsets[face]));
    for (size_t t = triangles_.faceTriangleOffsets[face]; t < triangles_.faceTriangleOffsets[face + 1]; ++t) {
      visit(std::span<const uint32_t>(triangles_.triangles.data() + 3 * t, 3));
    }
  }

 private:
  const CutMesh& cutMesh_;
  std::vector<uint8_t> split_;  // per face
  FaceTriangles triangles_;     // empty if no face is split
};

}  // namespace mandoline::detail
