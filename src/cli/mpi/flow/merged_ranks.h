// Small cells merged with neighbours, where several processes have a part of them each.
#pragma once

#include "mandoline/distributed.h"
#include "mpi/communicator.h"

namespace mandoline::cli {

/// Rings of cells that velocities and corrections of own cells follow from.
constexpr int kFlowGhosts = 3;

/// A process's cells for solveRankFlow(): as mergeSmallCells() of the whole makes them, to the bit, for a fraction of 0 all as they are, of
/// the octree cells that `coarsening` makes, or for a maxLevel of 0 of grid cells. A merged cell belongs to the process of its first
/// member. There are so many layers of ghosts that those which are nearer than that are complete, with all that is in their faces; others
/// may lack members. All but vertices and faces has the whole's ids. Collective.
///
/// Which cells merge the first process decides, which is told volumes, centroids and areas of all. It tells all which cells are no longer
/// the first of theirs.
RankComplex mergedComplex(detail::Communicator& comm, const DistributedCut& cut, double fraction, const CoarsenOptions& coarsening);

}  // namespace mandoline::cli
