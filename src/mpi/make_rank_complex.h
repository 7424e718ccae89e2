// A process's cells of the cell complex of the whole.
#pragma once

#include "mandoline/distributed.h"

namespace mandoline::detail {

class Communicator;

/// What all processes know alike.
struct WholeCut {
  const MeshView mesh;
  const CutMesh& common;  ///< that of the share
  const CutCounts& counts;
};

/// As DistributedCut::cellComplex().
RankComplex makeRankComplex(Communicator& comm, const WholeCut& whole, const RankPiece& piece, int ghostLayers);

}  // namespace mandoline::detail
