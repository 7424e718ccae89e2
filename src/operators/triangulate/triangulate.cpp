#include "mandoline/triangulate.h"

#include "operators/require_cut_mesh.h"
#include "operators/triangulate/face_triangulator.h"

namespace mandoline {

FaceTriangles triangulateFaces(const CutMesh& cutMesh) {
  operators::requireNotEmpty(cutMesh);
  FaceTriangles result;
  result.faceTriangleOffsets.reserve(cutMesh.faceCount() + 1);
  result.faceTriangleOffsets.push_back(0);
  result.triangles.reserve(3 * cutMesh.loopVertices.size());
  operators::FaceTriangulator triangulator(cutMesh.positions);
  for (size_t f = 0; f < cutMesh.faceCount(); ++f) {
    triangulator.run(cutMesh.face(f), result.triangles);
    result.faceTriangleOffsets.push_back(uint32_t(result.triangles.size() / 3));
  }
  result.madeFrom = cutMesh.fingerprint;
  return result;
}

std::vector<uint32_t> triangulateCell(const CutMesh& cutMesh, size_t cell) {
  operators::requireNotEmpty(cutMesh);
  if (cell >= cutMesh.cellCount()) {
    operators::refuse("There is no cut-cell " + std::to_string(cell) + ": there are " + std::to_string(cutMesh.cellCount()) + ".",
                      int64_t(cell));
  }
  std::vector<uint32_t> triangles;
  operators::FaceTriangulator triangulator(cutMesh.positions);
  for (const uint32_t h : cutMesh.halfFaces(cell)) triangulator.runOutwards(cutMesh.face(h / 2), h % 2, triangles);
  return triangles;
}

std::vector<uint32_t> triangulateRegion(const CutMesh& cutMesh, uint32_t region) {
  operators::requireNotEmpty(cutMesh);
  if (region >= cutMesh.regionCount) {
    operators::refuse("There is no region " + std::to_string(region) + ": there are " + std::to_string(cutMesh.regionCount) + ".", region);
  }
  std::vector<uint32_t> triangles;
  operators::FaceTriangulator triangulator(cutMesh.positions);
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    if (cutMesh.cellRegion[c] != region) continue;
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      if (cutMesh.faceTriangle[h / 2] >= 0) triangulator.runOutwards(cutMesh.face(h / 2), h % 2, triangles);
    }
  }
  return triangles;
}

}  // namespace mandoline
