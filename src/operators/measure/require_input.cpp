#include "operators/measure/require_input.h"

#include <algorithm>
#include <cmath>

namespace mandoline::measuring {
namespace {

[[noreturn]] void refuse(const std::string& message, int64_t element = -1) { throw CallError({Status::badArgument, element, -1, message}); }
[[noreturn]] void refuseOther(const std::string& reason, int64_t element = -1) {
  refuse("The mesh is not the one that the cut-mesh was made from: " + reason + ".", element);
}

void requireArrays(const MeshView& mesh) {
  if (mesh.positions.size() % 3 != 0 || mesh.triangles.size() % 3 != 0)
    refuse("The length of an array of the mesh is not a multiple of 3.");
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangles[i] >= mesh.vertexCount())
      refuse("Triangle " + std::to_string(i / 3) + " of the mesh names a tri-vertex that does not exist.", int64_t(i / 3));
    const double* p = &mesh.positions[3 * size_t(mesh.triangles[i])];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      refuse("Tri-vertex " + std::to_string(mesh.triangles[i]) + " of the mesh is not finite.", mesh.triangles[i]);
  }
}

void requireIds(const MeshView& mesh, const CutMesh& cutMesh) {
  if (mesh.triangleCount() != cutMesh.triangleCount) {
    refuseOther("it has " + std::to_string(mesh.triangleCount()) + " triangles, that one had " + std::to_string(cutMesh.triangleCount));
  }
  const int64_t count = int64_t(mesh.vertexCount());
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) {
    const int32_t a = cutMesh.vertexParents[2 * v], b = cutMesh.vertexParents[2 * v + 1];
    if (cutMesh.vertexTriVertex[v] >= count || (b >= 0 && std::max(a, b) >= count))
      refuseOther("it lacks a tri-vertex of vertex " + std::to_string(v), int64_t(v));
  }
}

double largestCoordinate(const MeshView& mesh, const Grid& grid) {
  double largest = 0;
  for (const std::vector<double>& planes : grid.planes) {
    if (!planes.empty()) largest = std::max({largest, std::fabs(planes.front()), std::fabs(planes.back())});
  }
  for (const uint32_t v : mesh.triangles) {
    for (size_t d = 0; d < 3; ++d) largest = std::max(largest, std::fabs(mesh.positions[3 * size_t(v) + d]));
  }
  return largest;
}

/// Whether snapping can have moved x to plane c.
bool mayBeSnapped(double x, const std::vector<double>& planes, size_t c) {
  const double below = c > 0 ? planes[c] - planes[c - 1] : 0, above = c + 1 < planes.size() ? planes[c + 1] - planes[c] : 0;
  return std::fabs(x - planes[c]) <= std::max(below, above) / 2;
}

void requirePositions(const MeshView& mesh, const CutMesh& cutMesh) {
  const double flushed = std::ldexp(largestCoordinate(mesh, cutMesh.grid), -199);  // coordinates up to here may have been taken as 0
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) {
    const int32_t t = cutMesh.vertexTriVertex[v];
    for (size_t d = 0; t >= 0 && d < 3; ++d) {
      const double x = mesh.positions[3 * size_t(t) + d], position = cutMesh.positions[3 * v + d];
      if (x == position || (position == 0 && std::fabs(x) <= flushed)) continue;
      const bool onPlane = cutMesh.vertexMask[v] >> d & 1;
      if (!onPlane || !mayBeSnapped(x, cutMesh.grid.planes[d], size_t(cutMesh.vertexCell[3 * v + d])))
        refuseOther("it has tri-vertex " + std::to_string(t) + " elsewhere", t);
    }
  }
}

struct Range {
  double low = INFINITY, high = -INFINITY;

  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  bool holds(double x, double slack) const { return x >= low - slack && x <= high + slack; }
};

Range rangeOf(const MeshView& mesh, size_t triangle, size_t d) {
  Range range;
  for (size_t i = 0; i < 3; ++i) range.add(mesh.positions[3 * size_t(mesh.triangles[3 * triangle + i]) + d]);
  return range;
}

/// The same with all places that snapping can have moved corners to.
Range snappedRangeOf(const MeshView& mesh, size_t triangle, size_t d, const std::vector<double>& planes) {
  Range range = rangeOf(mesh, triangle, d);
  for (size_t i = 0; i < 3; ++i) {
    const double x = mesh.positions[3 * size_t(mesh.triangles[3 * triangle + i]) + d];
    const size_t above = size_t(std::upper_bound(planes.begin(), planes.end(), x) - planes.begin());
    if (above < planes.size() && mayBeSnapped(x, planes, above)) range.add(planes[above]);
    if (above > 0 && mayBeSnapped(x, planes, above - 1)) range.add(planes[above - 1]);
  }
  return range;
}

}  // namespace

void requireInput(const MeshView& mesh, const CutMesh& cutMesh) {
  requireArrays(mesh);
  requireIds(mesh, cutMesh);
  requirePositions(mesh, cutMesh);
}

void requireTriangles(const MeshView& mesh, const CutMesh& cutMesh) {
  const double rounding = std::ldexp(largestCoordinate(mesh, cutMesh.grid), -30);  // far more than the vertices' own
  for (size_t f = 0; f < cutMesh.faceCount(); ++f) {
    if (cutMesh.faceTriangle[f] < 0) continue;
    const auto triangle = size_t(cutMesh.faceTriangle[f]);
    const double* position = &cutMesh.positions[3 * size_t(cutMesh.loops(f)[0][0])];
    for (size_t d = 0; d < 3; ++d) {
      const double x = position[d];
      if (rangeOf(mesh, triangle, d).holds(x, rounding)) continue;
      if (snappedRangeOf(mesh, triangle, d, cutMesh.grid.planes[d]).holds(x, rounding)) continue;
      refuseOther("it has triangle " + std::to_string(triangle) + " elsewhere", int64_t(triangle));
    }
  }
}

}  // namespace mandoline::measuring
