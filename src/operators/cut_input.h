// The mesh that a cut-mesh was made from, as the cutter had it.
#pragma once

#include <optional>

#include "base/shared.h"
#include "grid/snap.h"
#include "mandoline/cut_mesh.h"

namespace mandoline::operators {

class MANDOLINE_SHARED CutInput {
 public:
  /// Throws CallError unless the mesh is the one that the cut-mesh was made from; of a cut-mesh from elsewhere, unless the mesh has as many
  /// triangles, and the tri-vertices that the cut-mesh names; and for that of refined cells, unless it may be one. The mesh has to outlive
  /// this.
  CutInput(const MeshView& mesh, const CutMesh& cutMesh, bool mayBeRefined = false);

  /// With the tri-vertices where snapping has moved them.
  MeshView mesh() const { return snapped_ ? MeshView(snapped_->mesh) : mesh_; }

 private:
  MeshView mesh_;
  std::optional<detail::SnappedMesh> snapped_;
};

}  // namespace mandoline::operators
