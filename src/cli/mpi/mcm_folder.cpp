#include "cli/mpi/mcm_folder.h"

#include <filesystem>

#include "cli/mpi/rank_files.h"

namespace mandoline::cli {
namespace {

namespace fs = std::filesystem;

void makeFolder(const std::string& path) {
  try {
    fs::create_directories(path);
  } catch (const fs::filesystem_error& error) {
    throw FileError(path + ": can't be written: " + error.code().message());
  }
}

}  // namespace

bool isMcmFolder(const std::string& path) { return path.ends_with(".mcm/"); }

void writeMcmFolder(Ranks& ranks, const std::string& path, const RankPiece& piece, const RunOptions& options) {
  const DeferInterrupts defer;  // which would leave the folder
  const auto nameOf = [&](int rank) { return path + "piece_" + std::to_string(rank) + ".mcm"; };
  ranks.inFirst([&] {
    makeFolder(path);
    // The whole is read from all files that are there.
    if (const std::string next = nameOf(ranks.size()); fs::exists(next))
      throw FileError(next + ": is there already, of a cut in more pieces");
  });
  try {
    RankFiles pieces(ranks, nameOf);
    pieces.write(true, [&](const Sink& sink) { writeMcm(sink, piece, options); });
    pieces.complete();
  } catch (...) {
    std::error_code ignored;
    fs::remove(fs::path(path).parent_path(), ignored);  // if empty
    throw;
  }
}

}  // namespace mandoline::cli
