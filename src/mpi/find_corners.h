// The vertices of a slice's triangles, of which other processes have some.
#pragma once

#include "mpi/sliced_mesh.h"

namespace mandoline::detail {

/// Of a mesh whose slices are known; makes isFit, and if it is, part and isReferenced.
void findCorners(Communicator& comm, SlicedMeshData& mesh);

}  // namespace mandoline::detail
