#include "operators/cut_input.h"

#include <algorithm>
#include <cmath>

#include "mesh/fingerprints.h"
#include "operators/require_cut_mesh.h"

namespace mandoline::operators {
namespace {

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

}  // namespace

CutInput::CutInput(const MeshView& mesh, const CutMesh& cutMesh, bool mayBeRefined) : mesh_(mesh) {
  requireArrays(mesh);
  if (!mayBeRefined) refuseRefined(cutMesh);
  requireIds(mesh, cutMesh);
  if (cutMesh.madeFrom.isKnown() && detail::fingerprintOf(mesh) != cutMesh.madeFrom) refuseOther("its positions or triangles are others");
  if (cutMesh.snapTolerance > 0) snapped_ = detail::snapped(mesh, cutMesh.grid, cutMesh.snapTolerance);
}

}  // namespace mandoline::operators
