#include "mandoline/inspect.h"

#include <algorithm>
#include <cmath>

#include "base/exact.h"
#include "base/position_table.h"
#include "base/sort.h"
#include "mesh/inspect_arrays.h"
#include "mesh/inspect_edges.h"
#include "mesh/require_arrays.h"

namespace mandoline {
namespace {

using detail::Corners, detail::hasThreeVertices, detail::isFinite;

size_t countDuplicates(std::vector<Corners> triangles, size_t vertices) {
  for (Corners& t : triangles) detail::sortItems(t);
  detail::sortByKeys(
      triangles, vertices, [](const Corners& t) { return t[0]; }, std::less<>());
  size_t count = 0;
  for (size_t t = 1; t < triangles.size(); ++t) count += hasThreeVertices(triangles[t]) && triangles[t] == triangles[t - 1];
  return count;
}

size_t countZeroArea(const MeshView& mesh, const std::vector<Corners>& triangles) {
  double largest = 0;
  for (const double x : mesh.positions) {
    if (std::isfinite(x)) largest = std::max(largest, std::fabs(x));
  }
  // A power of two, so that no product of coordinates overflows or underflows.
  const int shift = largest > 0 ? 120 - std::ilogb(largest) : 0;
  const auto coordinate = [&](uint32_t v, int d) { return std::ldexp(mesh.positions[3 * size_t(v) + size_t(d)], shift); };
  detail::Predicates predicates;
  const auto isFlat = [&](const Corners& t) {
    for (int d = 0; d < 3; ++d) {
      const int p = (d + 1) % 3, q = (d + 2) % 3;
      if (predicates.orient2d({coordinate(t[0], p), coordinate(t[0], q)}, {coordinate(t[1], p), coordinate(t[1], q)},
                              {coordinate(t[2], p), coordinate(t[2], q)}) != 0) {
        return false;
      }
    }
    return true;
  };
  size_t count = 0;
  for (const Corners& t : triangles) {
    const bool finite = isFinite(mesh, t[0]) && isFinite(mesh, t[1]) && isFinite(mesh, t[2]);
    count += finite && (!hasThreeVertices(t) || isFlat(t));
  }
  return count;
}

}  // namespace

MeshBox boxOf(const MeshView& mesh) {
  detail::requireArrays(mesh);
  MeshBox box;
  box.min.fill(INFINITY);
  box.max.fill(-INFINITY);
  for (const uint32_t v : mesh.triangles) {
    for (size_t d = 0; d < 3; ++d) {
      const double x = mesh.positions[3 * size_t(v) + d];
      if (!std::isfinite(x)) continue;
      box.min[d] = std::min(box.min[d], x);
      box.max[d] = std::max(box.max[d], x);
    }
  }
  for (size_t d = 0; d < 3; ++d) {
    if (!(box.min[d] <= box.max[d])) box.min[d] = box.max[d] = 0;
  }
  return box;
}

MeshInfo inspect(const MeshView& mesh) {
  MeshInfo info = detail::inspectArrays(mesh);
  const std::vector<uint32_t> lowest = detail::lowestAtPosition(
      info.vertices, [&](uint32_t v) { return mesh.positions.data() + 3 * size_t(v); }, [&](uint32_t v) { return isFinite(mesh, v); });
  std::vector<uint8_t> referenced(info.vertices, 0);
  for (const uint32_t v : mesh.triangles) referenced[v] = 1;
  for (uint32_t v = 0; v < info.vertices; ++v) {
    info.weldedVertices += lowest[v] != v;
    info.unreferencedVertices += referenced[v] == 0;
    info.nonFiniteVertices += !isFinite(mesh, v);
  }
  std::vector<Corners> triangles(info.triangles);
  for (size_t t = 0; t < info.triangles; ++t) {
    for (size_t i = 0; i < 3; ++i) triangles[t][i] = lowest[mesh.triangles[3 * t + i]];
  }
  detail::inspectEdges(mesh, triangles, info);
  info.zeroAreaTriangles = countZeroArea(mesh, triangles);
  info.duplicateTriangles = countDuplicates(std::move(triangles), info.vertices);
  return info;
}

}  // namespace mandoline
