// mandoline-mpi cut.
#pragma once

#include "cli/arguments.h"
#include "cli/mpi/ranks.h"

namespace mandoline::cli {

/// Whether so many processes each go through all of a binary file for what they cut; more would wait longer for the file than to be told
/// by others, of which each then reads its slice only.
constexpr bool readsFileInAll(size_t processes) { return processes <= 16; }

/// Collective. Gives the exit code, the same in all processes. Throws UsageError, alike in all, and Stopped.
int runDistributedCut(Ranks& ranks, const Arguments& arguments);

}  // namespace mandoline::cli
