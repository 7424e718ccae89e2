#include "mesh/require_arrays.h"

#include <string>

#include "mandoline/status.h"

namespace mandoline::detail {

void requireArrays(const MeshView& mesh) {
  const auto refuse = [](Status status, int64_t element, const std::string& message) { throw CallError({status, element, -1, message}); };
  if (mesh.positions.size() % 3 != 0) refuse(Status::badArrays, -1, "The length of positions is not a multiple of 3.");
  if (mesh.triangles.size() % 3 != 0) refuse(Status::badArrays, -1, "The length of triangles is not a multiple of 3.");
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.triangles[i] < mesh.vertexCount()) continue;
    const size_t t = i / 3;
    refuse(Status::badIndex, int64_t(t),
           "Triangle " + std::to_string(t) + " refers to vertex " + std::to_string(mesh.triangles[i]) + ", but there are only " +
               std::to_string(mesh.vertexCount()) + ".");
  }
}

}  // namespace mandoline::detail
