#include "operators/require_cut_mesh.h"

namespace mandoline::operators {

void refuse(const std::string& message, int64_t element) { throw CallError({Status::badArgument, element, -1, message}); }

void requireCutMesh(const CutMesh& cutMesh) {
  if (cutMesh.rowRunOffsets.empty()) refuse("The cut-mesh is empty: cut() makes one.");
}

}  // namespace mandoline::operators
