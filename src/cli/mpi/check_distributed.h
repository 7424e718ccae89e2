// What is asked of several processes: whether they can do it, and who writes what.
#pragma once

#include "cli/arguments.h"

namespace mandoline::cli {

/// Throws UsageError if several processes can't do what is asked.
void checkDistributed(const Arguments& arguments);

/// Whether each process writes a piece of an output.
bool isInPieces(const std::string& output);
/// The outputs that the first process writes, of the whole cut.
Arguments ofWhole(const Arguments& arguments);
/// Whether the first process has to have the whole cut.
bool needsWhole(const Arguments& arguments);

}  // namespace mandoline::cli
