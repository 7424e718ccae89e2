// Measuring by a part of the mesh.
#pragma once

#include "mandoline/measure.h"
#include "mesh/mesh_part.h"

namespace mandoline::measuring {

/// What measuring asks for of the mesh.
MANDOLINE_SHARED detail::MeshPart partMeasuredBy(const CutMesh& cutMesh, const detail::NamedMesh& mesh);

/// As measure(), by what has at least that. Whether it is of the cut-mesh's mesh is not checked.
MANDOLINE_SHARED Measures measureBy(const detail::NamedMesh& mesh, const CutMesh& cutMesh, const RunOptions& options);

}  // namespace mandoline::measuring
