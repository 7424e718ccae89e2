// mandoline-mpi flow.
#pragma once

#include "cli/flow_command.h"
#include "cli/mpi/ranks.h"
#include "mandoline/distributed.h"
#include "mandoline/mesh_files.h"

namespace mandoline::cli {

/// Throws UsageError for what several processes can't do.
void checkDistributedFlow(const Arguments& arguments);

/// Collective: solves, and gives the first process what finishFlow() takes of the whole. `groups`: in all processes if walls unite. Throws
/// Stopped and RankError, and as solveRankFlow() does.
SolveCells solveDistributed(Ranks& ranks, const Arguments& arguments, const DistributedCut& cut, const TriangleGroups& groups);

}  // namespace mandoline::cli
