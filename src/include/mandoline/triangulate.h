// Triangles of cut-faces and cut-cells, for rendering and export (paper, 4.7).
#pragma once

#include <vector>

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// Triangles of every face. No vertices are added and a face has one triangulation, used by the cells on both sides, so neighbours match.
struct FaceTriangles {
  std::vector<uint32_t> faceTriangleOffsets;  ///< into triangles (in triangles, not entries), per face
  std::vector<uint32_t> triangles;            ///< 3 vertex ids per triangle, counter-clockwise about the face's normal
  Fingerprint madeFrom;                       ///< of the cut-mesh

  static void fields(auto& self, const auto& f) {
    f("faceTriangleOffsets", self.faceTriangleOffsets);
    f("triangles", self.triangles);
    f("madeFrom", self.madeFrom);
  }
};
/// Throws CallError if the cut-mesh is empty.
FaceTriangles triangulateFaces(const CutMesh& cutMesh);

/// The closed triangle surface of one cut-cell, oriented outward: 3 vertex ids per triangle, those of triangulateFaces(). Costs what the
/// cell's faces cost. Throws CallError if there is no such cell (element).
std::vector<uint32_t> triangulateCell(const CutMesh& cutMesh, size_t cell);

/// The pieces of triangles that bound a region, seen from its cut-cells and oriented out of it: 3 vertex ids per triangle, those of
/// triangulateFaces(). Where a sheet ends within the region, both of its sides. Throws CallError if there is no such region (element).
std::vector<uint32_t> triangulateRegion(const CutMesh& cutMesh, uint32_t region);

}  // namespace mandoline
