// Whether a mesh can be the one that a cut-mesh was made from.
#pragma once

#include "base/shared.h"
#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace mandoline::measuring {

/// Throws CallError unless the mesh has the triangles and tri-vertices that the cut-mesh names, where it has them (on planes they may have
/// been snapped). Then nothing that looks up the cut-mesh's triangles or tri-vertices in the mesh goes astray.
MANDOLINE_SHARED void requireInput(const MeshView& mesh, const CutMesh& cutMesh);

/// Of such a mesh: throws CallError unless each face begins in the box of its triangle. If triangles have been reordered, some don't.
void requireTriangles(const MeshView& mesh, const CutMesh& cutMesh);

}  // namespace mandoline::measuring
