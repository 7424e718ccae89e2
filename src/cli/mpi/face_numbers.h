// Which numbers the faces of a process have in the polyMesh of the whole.
#pragma once

#include "io/poly_mesh.h"
#include "mandoline/distributed.h"
#include "mpi/communicator.h"

namespace mandoline::cli {

/// A process's cells, and what is written of them.
struct RankCells {
  const RankComplex& complex;
  const CoarsenOptions& coarsening;  ///< that it was made with; with maxLevel 0 without
  const detail::ComplexPolygons& polygons;
};

/// Collective. Per face of `mesh`, in its order: the number from 0. That of writePolyMesh() for all cells of the whole; a face of several
/// polygons has as many numbers. `mesh` has the process's own cells, and after the patches of the whole one for each seam, in their order,
/// with its inner faces. `common` is DistributedCut::common(). Throws RankError.
std::vector<uint64_t> faceNumbers(detail::Communicator& comm, const CutMesh& common, const RankCells& mine, const detail::PolyMesh& mesh);

}  // namespace mandoline::cli
