// What a plane cuts out of the faces: points on edges of their triangles, and segments between them.
#pragma once

#include "mandoline/mandoline.h"
#include "operators/cutting_plane.h"

namespace mandoline::operators {

/// A triangle that the plane cuts. Seen from the triangle's side 0 and with the plane's normal up, what is above lies to the left of the
/// way from point 0 to point 1; from side 1, to the left of the way back.
struct SliceSegment {
  std::array<uint32_t, 2> points;
  std::array<uint32_t, 2> tips;  ///< per point: the triangle's vertex off the edge that it lies on
};

struct SliceSegments {
  std::vector<SliceSegment> segments;
  std::vector<uint32_t> faceOffsets;                      ///< into segments, per face
  std::vector<std::array<uint32_t, 2>> pointEdges;        ///< per point: the edge's vertices, above and below the plane. No edge has two points
};

SliceSegments makeSliceSegments(const CutMesh& cutMesh, const ScaledSpace& space, const CuttingPlane& plane);

}  // namespace mandoline::operators
