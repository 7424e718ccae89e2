// The command cut, in steps: mandoline-mpi cuts in its own way.
#pragma once

#include "cli/input.h"
#include "cli/report.h"

namespace mandoline::cli {

/// What can be told of the outputs before there is a mesh. Throws UsageError, and FileError for one in a folder that does not exist.
void checkCutOutputs(const Arguments& arguments);

/// Whether files of cells have those of a cell complex.
bool needsComplex(const Arguments& arguments);

/// Says which part of a polyMesh of merged cells is left out, if there is one. `atSides`: see detail::regionsAtSides().
void noteLeftOut(const std::string& path, const std::vector<uint8_t>& atSides);

/// What was asked for.
struct CutJob {
  const Arguments& arguments;
  const Input& input;
  const MeshInfo& info;
  const AskedGrid& grid;
};

/// Reports a whole cut and writes its outputs. Gives the exit code. `ranks`: of several processes.
int finishCut(const CutJob& job, const CutResult& result, const std::vector<RankReport>& ranks = {});

}  // namespace mandoline::cli
