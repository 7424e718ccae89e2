// Signs of the volumes that parts of a mesh enclose, exactly.
#pragma once

#include "mesh/orient/parts.h"
#include "mesh/welded_mesh.h"

namespace mandoline::detail {

/// Per part the sign of the volume that its triangles enclose, turned as `parts` has them; 0 where it can't be told. Cones close the holes
/// of an open part: its sign counts only if it is the same for every apex in the part's bounding box.
std::vector<int> volumeSigns(const WeldedMesh& mesh, const Parts& parts, Predicates& predicates);

}  // namespace mandoline::detail
