// mandoline-mpi cut.
#pragma once

#include "cli/arguments.h"
#include "cli/mpi/ranks.h"

namespace mandoline::cli {

/// Collective. Gives the exit code, the same in all processes. Throws UsageError, alike in all, and Stopped.
int runDistributedCut(Ranks& ranks, const Arguments& arguments);

}  // namespace mandoline::cli
