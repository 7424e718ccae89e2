#include "operators/triangulate/face_triangulator.h"

#include <algorithm>
#include <cmath>

#include "operators/unit_scale.h"

namespace mandoline::operators {
namespace {

using Vector = std::array<double, 3>;

/// How a face is seen: the axes that grow to the right and upwards, and a power of two that keeps products from over- and underflowing.
struct View {
  int right, up;
  double factor;

  PlanePoint operator()(const double* p) const { return {p[right] * factor, p[up] * factor}; }
};

double factorOf(const std::vector<double>& positions, const Loops& loops) {
  double largest = 0;
  for (const std::span<const uint32_t> loop : loops) {
    for (const uint32_t v : loop) {
      for (size_t d = 0; d < 3; ++d) largest = std::max(largest, std::fabs(positions[3 * size_t(v) + d]));
    }
  }
  return std::ldexp(1.0, unitExponent(largest));
}

/// Twice the loops' area along each axis.
Vector areaOf(const std::vector<double>& positions, const Loops& loops, double factor) {
  const auto position = [&](uint32_t v) { return &positions[3 * size_t(v)]; };
  const double* origin = position(loops[0][0]);
  Vector area = {};
  for (const std::span<const uint32_t> loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const double *a = position(loop[i]), *b = position(loop[i + 1 < loop.size() ? i + 1 : 0]);
      for (size_t d = 0; d < 3; ++d) {
        const size_t u = (d + 1) % 3, v = (d + 2) % 3;
        area[d] +=
            (a[u] - origin[u]) * factor * ((b[v] - origin[v]) * factor) - (a[v] - origin[v]) * factor * ((b[u] - origin[u]) * factor);
      }
    }
  }
  return area;
}

/// In the axial plane that the face is steepest to, seen so that its normal points up.
View viewOf(const std::vector<double>& positions, const Face& face) {
  const double factor = factorOf(positions, face.loops);
  int axis = face.axis;
  bool up = true;
  if (face.triangle >= 0) {
    const Vector area = areaOf(positions, face.loops, factor);
    const auto isSmaller = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
    if (axis < 0) axis = int(std::max_element(area.begin(), area.end(), isSmaller) - area.begin());
    up = area[size_t(axis)] >= 0;
  }
  return {(axis + (up ? 1 : 2)) % 3, (axis + (up ? 2 : 1)) % 3, factor};
}

}  // namespace

void FaceTriangulator::run(const Face& face, std::vector<uint32_t>& triangles) {
  if (const auto outer = face.loops[0]; face.loops.size() == 1 && outer.size() == 3) {
    triangles.insert(triangles.end(), outer.begin(), outer.end());
    return;
  }
  const View view = viewOf(positions_, face);
  for (const std::span<const uint32_t> loop : face.loops) {
    polygon_.startLoop();
    for (const uint32_t v : loop) polygon_.addCorner(v, view(&positions_[3 * size_t(v)]));
  }
  polygon_.run(triangles);
}

void FaceTriangulator::runOutwards(const Face& face, uint32_t side, std::vector<uint32_t>& triangles) {
  const size_t first = triangles.size();
  run(face, triangles);
  if (side == 0) return;
  for (size_t t = first; t < triangles.size(); t += 3) std::swap(triangles[t + 1], triangles[t + 2]);
}

}  // namespace mandoline::operators
