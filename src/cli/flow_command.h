// The command flow, in steps: mandoline-mpi solves in its own way.
#pragma once

#include "cli/cutting.h"
#include "cli/input.h"
#include "mandoline/flow.h"

namespace mandoline::cli {

/// What can be told of the outputs before there is a mesh. Throws UsageError, and FileError for one in a folder that does not exist.
void checkFlowOutputs(const Arguments& arguments);

/// What was asked for, and cut.
struct FlowJob {
  const Arguments& arguments;
  const Input& input;
  const CutResult& cut;
};
using SolveCells = std::function<Flow(const CellComplex& cells, const RunOptions& options)>;

/// Makes the cells, solves, reports and writes the outputs. Gives the exit code. `ranks`: of several processes.
int finishFlow(const FlowJob& job, const SolveCells& solve, const std::vector<RankReport>& ranks = {});

}  // namespace mandoline::cli
