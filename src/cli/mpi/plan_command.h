// mandoline-mpi plan.
#pragma once

#include "cli/mpi/ranks.h"

namespace mandoline::cli {

/// `words`: after the command. Collective: the first process works alone. Gives the exit code. Throws Stopped.
int runPlan(Ranks& ranks, std::vector<std::string> words);

}  // namespace mandoline::cli
