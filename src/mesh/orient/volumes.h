// Signs of the volumes that parts of a mesh enclose, exactly.
#pragma once

#include "mesh/orient/parts.h"
#include "mesh/welded_mesh.h"

namespace mandoline::detail {

/// Per part the sign of the volume that its triangles enclose, turned as `parts` has them; 0 where there is none to tell. Of an open part:
/// the sign that the volume has whatever point of the part's bounding box its holes are closed to by cones.
std::vector<int> volumeSigns(const WeldedMesh& mesh, const Parts& parts, Predicates& predicates);

}  // namespace mandoline::detail
