// A folder with a .mcm file of each process.
#pragma once

#include "cli/mpi/ranks.h"
#include "mandoline/io.h"

namespace mandoline::cli {

/// Whether the output is such a folder: FOLDER.mcm/.
bool isMcmFolder(const std::string& path);

/// Writes this process's piece; unless all are written, none is left. Collective. Throws Stopped, also where the folder has a piece of a
/// cut in more processes.
void writeMcmFolder(Ranks& ranks, const std::string& path, const RankPiece& piece, const RunOptions& options);

}  // namespace mandoline::cli
