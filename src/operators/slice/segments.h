// What a plane cuts out of the faces: points on edges of their triangles, and segments between them.
#pragma once

#include "mandoline/mandoline.h"
#include "operators/slice/cutting_plane.h"

namespace mandoline::operators {

/// Where the plane cuts a triangle: from one point to another. Seen from the triangle's side 0 and with the plane's normal up, what is
/// above lies to the left; seen from side 1, to the left of the way back.
using SliceSegment = std::array<uint32_t, 2>;

struct SliceSegments {
  std::vector<SliceSegment> segments;
  std::vector<uint32_t> faceOffsets;                ///< into segments, per face
  std::vector<std::array<uint32_t, 2>> pointEdges;  ///< per point: the vertices of the edge that it lies on. No edge has two points
};

SliceSegments makeSliceSegments(const CutMesh& cutMesh, const ScaledSpace& space, const CuttingPlane& plane);

}  // namespace mandoline::operators
