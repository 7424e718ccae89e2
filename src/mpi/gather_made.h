// The vertices that triangles make by meeting, of the parts of all processes.
#pragma once

#include "mpi/communicator.h"

namespace mandoline::detail {

/// Adds those of all parts to what all processes have alike of the result, and counts them.
void gatherMade(Communicator& comm, const CutMesh& part, CutResult& common);

}  // namespace mandoline::detail
