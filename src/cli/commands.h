// The commands. Each gives the program's exit code.
#pragma once

#include "cli/arguments.h"

namespace mandoline::cli {

enum ExitCode { kFine = 0, kNotCut = 1, kBadUsageOrFile = 2 };

int runCut(const Arguments& arguments);
int runStream(const Arguments& arguments);  ///< cut --stream
int runSlice(const Arguments& arguments);
int runBoundary(const Arguments& arguments);
int runFlow(const Arguments& arguments);
int runInfo(const Arguments& arguments);
int runMake(const Arguments& arguments);
int runResolve(const Arguments& arguments);

/// A message on standard error.
void complain(const std::string& message);

}  // namespace mandoline::cli
