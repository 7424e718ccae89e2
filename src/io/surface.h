// The cut surface by regions.
#pragma once

#include "io/selection.h"

namespace mandoline::detail {

/// Pieces of triangles by the region that lists them. Of all regions each face is listed once: by the one behind it, which an outward
/// oriented surface encloses, or by the one in front where the grid ends behind it. Of some regions each lists its whole boundary,
/// oriented out of it.
struct WrittenSurface {
  std::vector<uint32_t> regionOffsets;  ///< into halfFaces
  std::vector<uint32_t> halfFaces;      ///< 2 * face + side; side 1: the face is turned around

  std::span<const uint32_t> of(uint32_t region) const {
    return {halfFaces.data() + regionOffsets[region], regionOffsets[region + 1] - regionOffsets[region]};
  }
};
WrittenSurface surfaceOf(const Selection& selection);

/// The surface in triangles, with only the vertices that they use.
struct SurfaceTriangles {
  Mesh mesh;
  std::vector<uint32_t> region, face;  ///< per triangle
};
SurfaceTriangles triangulateSurface(const Selection& selection);

}  // namespace mandoline::detail
