// What the commands that cut have in common.
#pragma once

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

/// With progress.
CutResult cutMesh(const Arguments& arguments, const Mesh& mesh, const Grid& grid);

/// Throws UsageError for regions that the cut-mesh does not have.
WriteOptions writeOptions(const OnlyArguments& only, const CutMesh& cutMesh);

/// Of an output whose extension or --format has been checked.
FileFormat formatFor(const Arguments& arguments, const std::string& output);

/// "path: status: message".
std::string refusal(const std::string& meshName, const Error& error);

}  // namespace mandoline::cli
