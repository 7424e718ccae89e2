#include "io/surface.h"

#include "base/sort.h"
#include "mandoline/triangulate.h"
#include "operators/mesh_writer.h"

namespace mandoline::detail {
namespace {

/// Calls visit(region, half-face) for every listing of a face.
template <class Visit>
void forEachListing(const Selection& selection, const Visit& visit) {
  const CutMesh& m = selection.cutMesh();
  std::vector<uint8_t> hasBehind(selection.allRegions() ? m.faceCount() : 0, 0);
  for (const uint32_t h : m.cellHalfFaces) {
    if (h % 2 == 0 && !hasBehind.empty()) hasBehind[h / 2] = 1;
  }
  for (size_t c = 0; c < m.cellCount(); ++c) {
    if (!selection.hasCutCell(c)) continue;
    for (const uint32_t h : m.halfFaces(c)) {
      if (m.faceTriangle[h / 2] < 0) continue;
      if (!selection.allRegions()) {
        visit(m.cellRegion[c], h);
      } else if (h % 2 == 0 || !hasBehind[h / 2]) {
        visit(m.cellRegion[c], h - h % 2);
      }
    }
  }
}

}  // namespace

WrittenSurface surfaceOf(const Selection& selection) {
  WrittenSurface surface;
  surface.regionOffsets.assign(size_t(selection.cutMesh().regionCount) + 1, 0);
  forEachListing(selection, [&](uint32_t region, uint32_t) { ++surface.regionOffsets[region + 1]; });
  for (size_t r = 1; r < surface.regionOffsets.size(); ++r) surface.regionOffsets[r] += surface.regionOffsets[r - 1];
  surface.halfFaces.resize(surface.regionOffsets.back());
  std::vector<uint32_t> next(surface.regionOffsets.begin(), surface.regionOffsets.end() - 1);
  forEachListing(selection, [&](uint32_t region, uint32_t halfFace) { surface.halfFaces[next[region]++] = halfFace; });
  for (size_t r = 0; r + 1 < surface.regionOffsets.size(); ++r) {
    sortItems(
        std::span<uint32_t>(surface.halfFaces.data() + surface.regionOffsets[r], surface.regionOffsets[r + 1] - surface.regionOffsets[r]));
  }
  return surface;
}

SurfaceTriangles triangulateSurface(const Selection& selection) {
  const CutMesh& m = selection.cutMesh();
  const WrittenSurface surface = surfaceOf(selection);
  const FaceTriangles faces = triangulateFaces(m);
  SurfaceTriangles result;
  operators::MeshWriter writer(m.positions, result.mesh);
  for (uint32_t r = 0; r < m.regionCount; ++r) {
    for (const uint32_t h : surface.of(r)) {
      for (size_t t = faces.faceTriangleOffsets[h / 2]; t < faces.faceTriangleOffsets[h / 2 + 1]; ++t) {
        writer.add(&faces.triangles[3 * t], h % 2 == 1);
        result.region.push_back(r);
        result.face.push_back(h / 2);
      }
    }
  }
  return result;
}

}  // namespace mandoline::detail
