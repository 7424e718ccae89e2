// flow --steps: a flow in time; and what all flows are written by.
#pragma once

#include <span>

#include "cli/cutting.h"
#include "cli/input.h"

namespace mandoline::cli {

/// What a .vtu file has of a flow.
struct FlowFields {
  const CutMesh& cutMesh;
  const CellComplex& cells;
  std::span<const Field> ofCells;
  const std::vector<double>& faceVelocity;
};
/// All cells, or with --faces the faces.
void writeFlowVtu(const Arguments& arguments, const std::string& output, const FlowFields& fields, WriteOptions options);

/// Of velocities, 3 per cell. NaN if one of them is.
double largestSpeed(const std::vector<double>& cellVelocity);

/// What the steps are taken on.
struct SteppedCells {
  const Input& input;
  const CutMesh& cutMesh;
  const MergedCells& merged;
};

/// Steps as many times as --steps says, reports, and writes the flow as it is then. Gives the exit code.
int runSteps(const Arguments& arguments, const SteppedCells& stepped, const WriteOptions& options);

}  // namespace mandoline::cli
