// The vertices of the result: where they lie, what they come from, and their coordinates. Part of output_part.h.
#pragma once

#include "cut/stages/output_part.h"

namespace mandoline::detail {

struct VerticesToWrite {
  const std::vector<VertexId>& surface;  ///< those of the mesh and its edges, ascending, which come first
  const KeptVertices& kept;
};

/// Writes them, and those that bricks own, into the arrays of a result, which are long enough. `mesh` is that of the user.
void writeVertices(const MeshView& mesh, const CutState& state, const VerticesToWrite& vertices, CutMesh& out, Run& run);

}  // namespace mandoline::detail
