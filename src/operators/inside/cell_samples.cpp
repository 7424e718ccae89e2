#include "operators/inside/cell_samples.h"

namespace mandoline::operators {
namespace {

using detail::Point;

/// The square of twice the area.
double sizeOf(const Point& a, const Point& b, const Point& c) {
  double sum = 0;
  for (size_t d = 0; d < 3; ++d) {
    const size_t e = (d + 1) % 3, f = (d + 2) % 3;
    const double x = (b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]);
    sum += x * x;
  }
  return sum;
}

}  // namespace

CellSample CellSampler::sample(uint32_t cell) {
  CellSample best;
  double largest = -1;
  bool isOnGrid = false;
  uint32_t halfFace = 0;
  for (const uint32_t h : cutMesh_.halfFaces(cell)) {
    const Face face = cutMesh_.face(h / 2);
    if (isOnGrid && face.triangle >= 0) continue;
    triangles_.clear();
    triangulator_.run(face, triangles_);
    if (!isOnGrid && face.triangle < 0 && !triangles_.empty()) {
      isOnGrid = true;
      largest = -1;
    }
    for (size_t t = 0; t < triangles_.size(); t += 3) {
      const Point a = vertex(triangles_[t]), b = vertex(triangles_[t + 1]), c = vertex(triangles_[t + 2]);
      const double size = sizeOf(a, b, c);
      if (!(size > largest)) continue;
      largest = size;
      halfFace = h;
      for (size_t d = 0; d < 3; ++d) best.point[d] = a[d] / 3 + b[d] / 3 + c[d] / 3;
      if (isOnGrid) best.point[size_t(face.axis)] = a[size_t(face.axis)];
    }
  }
  if (isOnGrid) return best;
  int32_t signs = 0;
  const uint32_t face = halfFace / 2;
  for (uint32_t p = cutMesh_.faceParentOffsets[face]; p < cutMesh_.faceParentOffsets[face + 1]; ++p) {
    if (!isOpen_[cutMesh_.faceParents[p]]) continue;
    best.leftOut.push_back(cutMesh_.faceParents[p]);
    signs += cutMesh_.faceParentSigns[p];
  }
  best.step = (halfFace % 2 == 0 ? 0.5 : -0.5) * signs;
  return best;
}

}  // namespace mandoline::operators
