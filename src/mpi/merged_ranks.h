// Small cells merged with neighbours, where several processes have a part of them each.
#pragma once

#include "base/shared.h"
#include "mandoline/distributed.h"
#include "mandoline/merge.h"
#include "mpi/communicator.h"

namespace mandoline::detail {

struct RankMerging {
  double fraction;                     ///< as of MergeOptions; for 0 all cells stay as they are
  const CoarsenOptions& coarsening;    ///< for octree cells; with a maxLevel of 0 grid cells stay
  int rings;                           ///< of ghosts: cells that touch own cells, those that touch these, and so on
  const WallOptions* walls = nullptr;  ///< for pieces of triangles to be united; else these stay as they are
};

/// Of the whole.
struct MergedCounts {
  uint64_t before = 0, after = 0;  ///< cells
  uint64_t pockets = 0;            ///< as MergedCells::pockets
};

/// A process's cells, as mergeSmallCells() of the whole makes them, and uniteWalls() after that, to the bit. A merged cell belongs to the
/// process of its first member. There are so many layers of ghosts that the rings asked for are complete, and all that is in the faces of
/// those but the last; others may lack members. Vertices and cells have the whole's ids, and faces that of their first member in the whole
/// as it is before. `piece` is that of cut.piece(). `counts` may be null. Collective. Throws RankError.
///
/// Which cells merge the first process decides (mpi/absorbed_cells.h). It tells all which cells are no longer the first of theirs.
MANDOLINE_SHARED RankComplex mergedComplex(Communicator& comm, const DistributedCut& cut, const RankPiece& piece,
                                           const RankMerging& merging, MergedCounts* counts = nullptr);

}  // namespace mandoline::detail
