// Preparing a mesh in all processes of a communicator so that each has only what it cuts.
#pragma once

#include "cut/share_input.h"
#include "mpi/communicator.h"
#include "mpi/sliced_mesh.h"

namespace mandoline::detail {

/// The input of this process's share. Null, alike in all processes, for a mesh that has to be prepared as a whole, which also tells what is
/// wrong with it. `info`, which is null in all or in none, becomes what inspect() counts in the process of rank 0.
std::unique_ptr<ShareInput> prepareShares(Communicator& comm, const SlicedMeshData& mesh, const Grid& grid, const PrepareOptions& options,
                                          MeshInfo* info);

}  // namespace mandoline::detail
