// A .pvtu file and a .vtu file for each process, beside it.
#pragma once

#include "cli/mpi/ranks.h"
#include "mandoline/distributed.h"
#include "mandoline/io.h"

namespace mandoline::cli {

bool isPvtu(const std::string& path);

/// Writes this process's file, unless it would have no cells, and the first process the one that joins them. `path` ends with ".pvtu".
/// Unless all are written, none is left. Collective. Throws Stopped.
void writePvtu(Ranks& ranks, const std::string& path, const DistributedCut& cut, const RankPiece& piece, const WriteOptions& options);
/// The same of the cells of this process, of mergedComplex(), as writeVtu() writes those of the whole's cell complex.
void writePvtu(Ranks& ranks, const std::string& path, const RankComplex& complex, const WriteOptions& options);

}  // namespace mandoline::cli
