// Which numbers the cells, points and faces of a process have in the polyMesh of the whole.
#pragma once

#include "io/poly_mesh.h"
#include "mandoline/distributed.h"
#include "mpi/communicator.h"

namespace mandoline::cli {

/// From 0, as writePolyMesh() has them for all cells of the whole.
struct CaseNumbers {
  std::vector<uint64_t> cells;   ///< of those that are written, in their order
  std::vector<uint64_t> points;  ///< likewise
  std::vector<uint64_t> faces;   ///< per polygon of the faces of a mesh, in its order
};

/// Collective. `files.mesh` has the process's own cells, and after the patches of the whole one for each seam of `complex`, in their order,
/// with its inner faces. Throws RankError.
CaseNumbers caseNumbers(detail::Communicator& comm, const RankComplex& complex, const detail::PolyFiles& files);

}  // namespace mandoline::cli
