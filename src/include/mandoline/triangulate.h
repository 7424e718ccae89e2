// Triangles of cut-faces and cut-cells, for rendering and export (paper, 4.7).
#pragma once

#include "mandoline/mandoline.h"

namespace mandoline {

/// Triangles of every face. No vertices are added and a face has one triangulation, used by the cells on both sides, so neighbours match.
struct FaceTriangles {
  std::vector<uint32_t> faceTriangleOffsets;  ///< into triangles (in triangles, not entries), per face
  std::vector<uint32_t> triangles;            ///< 3 vertex ids per triangle, counter-clockwise about the face's normal
};
FaceTriangles triangulateFaces(const CutMesh& cutMesh);

/// The closed triangle surface of one cut-cell, oriented outward: 3 vertex ids per triangle.
std::vector<uint32_t> triangulateCell(const CutMesh& cutMesh, const FaceTriangles& faces, size_t cell);

/// The pieces of triangles that bound a region, seen from its cut-cells and oriented out of it: 3 vertex ids per triangle. Where a sheet
/// ends within the region, both of its sides.
std::vector<uint32_t> triangulateRegion(const CutMesh& cutMesh, const FaceTriangles& faces, uint32_t region);

}  // namespace mandoline
