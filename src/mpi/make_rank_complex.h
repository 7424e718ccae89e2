// A process's cells of the cell complex of the whole.
#pragma once

#include "mandoline/distributed.h"
#include "mesh/mesh_part.h"

namespace mandoline::detail {

class Communicator;

/// What a process knows of the whole.
struct WholeCut {
  const NamedMesh surface;  ///< has what measuring the piece takes
  const CutMesh& common;    ///< that of the share
  const CutCounts& counts;
};

/// As DistributedCut::cellComplex(). `coarsening`: null for grid cells as they are.
RankComplex makeRankComplex(Communicator& comm, const WholeCut& whole, const RankPiece& piece, int ghosts,
                            const CoarsenOptions* coarsening);

/// What cells of a process share with those of others. `cellRanks`: per cell.
std::vector<ComplexSeam> seamsOf(const CellComplex& cells, const std::vector<int32_t>& cellRanks, int rank);

}  // namespace mandoline::detail
