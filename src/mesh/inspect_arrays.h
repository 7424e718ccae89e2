// What inspect() tells of a mesh's arrays as they are.
#pragma once

#include <cmath>

#include "mandoline/inspect.h"

namespace mandoline::detail {

inline bool isFinite(const MeshView& mesh, size_t v) {
  return std::isfinite(mesh.positions[3 * v]) && std::isfinite(mesh.positions[3 * v + 1]) && std::isfinite(mesh.positions[3 * v + 2]);
}

/// Its box, and how many vertices and triangles it has.
inline MeshInfo inspectArrays(const MeshView& mesh) {
  MeshInfo info;
  const MeshBox box = boxOf(mesh);
  info.min = box.min;
  info.max = box.max;
  info.vertices = mesh.vertexCount();
  info.triangles = mesh.triangleCount();
  return info;
}

}  // namespace mandoline::detail
