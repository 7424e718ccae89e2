// Faces are triangulated in the axial plane that they are steepest to, seen so that their normal points up.
#include "mandoline/triangulate.h"

#include <algorithm>
#include <cmath>

#include "operators/triangulate/face_triangulator.h"

namespace mandoline {
namespace operators {
namespace {

/// How a face is seen: the axes that grow to the right and upwards, and a power of two that keeps products from over- and underflowing.
struct View {
  int right = 0, up = 1;
  double factor = 1;

  PlanePoint operator()(const double* p) const { return {p[right] * factor, p[up] * factor}; }
};

View viewOf(const CutMesh& cutMesh, size_t face) {
  View view;
  const auto loops = [&](const auto& f) {
    for (uint32_t l = cutMesh.faceLoopOffsets[face]; l < cutMesh.faceLoopOffsets[face + 1]; ++l) f(cutMesh.loop(l));
  };
  const auto position = [&](uint32_t v) { return &cutMesh.positions[3 * size_t(v)]; };
  const double* origin = nullptr;
  double largest = 0;
  loops([&](std::span<const uint32_t> loop) {
    for (const uint32_t v : loop) {
      if (!origin) origin = position(v);
      for (int d = 0; d < 3; ++d) largest = std::max(largest, std::fabs(position(v)[d]));
    }
  });
  if (largest > 0) view.factor = std::ldexp(1.0, -std::clamp(std::ilogb(largest), -1000, 1000));
  const double factor = view.factor;

  int axis = cutMesh.faceAxis[face];
  bool up = true;
  if (cutMesh.faceTriangle[face] >= 0) {
    double area[3] = {0, 0, 0};
    loops([&](std::span<const uint32_t> loop) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const double *a = position(loop[i]), *b = position(loop[i + 1 < loop.size() ? i + 1 : 0]);
        for (int d = 0; d < 3; ++d) {
          const int u = (d + 1) % 3, v = (d + 2) % 3;
          area[d] +=
              (a[u] - origin[u]) * factor * ((b[v] - origin[v]) * factor) - (a[v] - origin[v]) * factor * ((b[u] - origin[u]) * factor);
        }
      }
    });
    if (axis < 0) axis = int(std::max_element(area, area + 3, [](double a, double b) { return std::fabs(a) < std::fabs(b); }) - area);
    up = area[axis] >= 0;
  }
  view.right = (axis + (up ? 1 : 2)) % 3;
  view.up = (axis + (up ? 2 : 1)) % 3;
  return view;
}

}  // namespace

void FaceTriangulator::run(size_t face, std::vector<uint32_t>& triangles) {
  const View view = viewOf(cutMesh_, face);
  for (uint32_t l = cutMesh_.faceLoopOffsets[face]; l < cutMesh_.faceLoopOffsets[face + 1]; ++l) {
    polygon_.startLoop();
    for (const uint32_t v : cutMesh_.loop(l)) polygon_.addCorner(v, view(&cutMesh_.positions[3 * size_t(v)]));
  }
  polygon_.run(triangles);
}

}  // namespace operators

namespace {

/// Appends the triangles of a half-face, oriented out of its cell.
void addHalfFace(const FaceTriangles& faces, uint32_t halfFace, std::vector<uint32_t>& triangles) {
  for (uint32_t t = faces.faceTriangleOffsets[halfFace / 2]; t < faces.faceTriangleOffsets[halfFace / 2 + 1]; ++t) {
    const uint32_t* v = &faces.triangles[3 * size_t(t)];
    const uint32_t side = halfFace % 2;
    triangles.insert(triangles.end(), {v[0], v[1 + side], v[2 - side]});
  }
}

}  // namespace

FaceTriangles triangulateFaces(const CutMesh& cutMesh) {
  FaceTriangles result;
  result.faceTriangleOffsets.reserve(cutMesh.faceCount() + 1);
  result.faceTriangleOffsets.push_back(0);
  result.triangles.reserve(3 * cutMesh.loopVertices.size());
  operators::FaceTriangulator triangulator(cutMesh);
  for (size_t f = 0; f < cutMesh.faceCount(); ++f) {
    triangulator.run(f, result.triangles);
    result.faceTriangleOffsets.push_back(uint32_t(result.triangles.size() / 3));
  }
  return result;
}

std::vector<uint32_t> triangulateCell(const CutMesh& cutMesh, const FaceTriangles& faces, size_t cell) {
  std::vector<uint32_t> triangles;
  for (const uint32_t h : cutMesh.halfFaces(cell)) addHalfFace(faces, h, triangles);
  return triangles;
}

std::vector<uint32_t> triangulateRegion(const CutMesh& cutMesh, const FaceTriangles& faces, uint32_t region) {
  std::vector<uint32_t> triangles;
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    if (cutMesh.cellRegion[c] != region) continue;
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      if (cutMesh.faceTriangle[h / 2] >= 0) addHalfFace(faces, h, triangles);
    }
  }
  return triangles;
}

}  // namespace mandoline
