// What the commands that cut have in common.
#pragma once

#include <optional>
#include <type_traits>

#include "cli/arguments.h"
#include "cli/progress_bar.h"

namespace mandoline::cli {

/// Calls work(RunOptions) and shows how far it has come. Throws Interrupted.
template <class Work>
auto withProgress(unsigned threads, const Work& work) {
  ProgressBar bar;
  const RunOptions options{threads, [&](const Progress& progress) { return bar.update(progress); }};
  try {
    if constexpr (std::is_void_v<decltype(work(options))>) {
      work(options);
      throwIfInterrupted();
    } else {
      auto result = work(options);
      throwIfInterrupted();
      return result;
    }
  } catch (const CallError&) {
    throwIfInterrupted();
    throw;
  }
}

/// Throws UsageError for an output of a format that is not allowed, `rule` saying which are, and if two of the files are the same.
void checkOutputs(const Arguments& arguments, bool (*isAllowed)(FileFormat), const std::string& rule);

/// Whether one of the outputs is standard output.
bool takesStandardOutput(const Arguments& arguments);

/// With progress.
CutResult cutMesh(const Arguments& arguments, const Mesh& mesh, const Grid& grid);

/// The same with the grid that is asked for; if it fails, says why and gives nothing.
std::optional<CutMesh> cutOrComplain(const Arguments& arguments, const Mesh& mesh, const GridArguments& grid);

/// All cells, merged as far as --coarsen says. With progress.
CellComplex makeCells(const Arguments& arguments, const Mesh& mesh, const CutMesh& cutMesh);

/// Throws UsageError for regions that the cut-mesh does not have.
WriteOptions writeOptions(const OnlyArguments& only, const CutMesh& cutMesh);

/// Of an output whose extension or --format has been checked.
FileFormat formatFor(const Arguments& arguments, const std::string& output);

/// "path: status: message".
std::string refusal(const std::string& meshName, const Error& error);

}  // namespace mandoline::cli
