// Signs of the volumes that patches of a mesh enclose, exactly.
#pragma once

#include "mesh/orient/patches.h"
#include "mesh/welded_mesh.h"

namespace mandoline::detail {

/// Per patch the sign of the volume that its triangles enclose, turned as `patches` has them; 0 where it can't be told. Cones close the
/// holes of an open patch: its sign counts only if it is the same for every apex in the patch's bounding box.
std::vector<int> volumeSigns(const WeldedMesh& mesh, const Patches& patches, Predicates& predicates);

}  // namespace mandoline::detail
