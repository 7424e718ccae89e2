#include "cli/mpi/mcm_folder.h"

#include <filesystem>

#include "cli/files.h"

namespace mandoline::cli {

namespace fs = std::filesystem;

bool isMcmFolder(const std::string& path) { return path.ends_with(".mcm/"); }

McmFolder::McmFolder(Ranks& ranks, std::string path) : ranks_(ranks), path_(std::move(path)) {}

/// Those of all processes: one that was killed has left what it was writing.
McmFolder::~McmFolder() {
  if (isComplete_) return;
  std::error_code ignored;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    fs::remove(pieceName(rank), ignored);
    fs::remove(pieceName(rank) + ".part", ignored);
  }
  fs::remove(fs::path(path_).parent_path(), ignored);  // if empty
}

void McmFolder::make() {
  try {
    fs::create_directories(path_);
  } catch (const fs::filesystem_error& error) {
    throw FileError(path_ + ": can't be written: " + error.code().message());
  }
  // The whole is read from all files that are there.
  if (const std::string next = pieceName(ranks_.size()); fs::exists(next))
    throw FileError(next + ": is there already, of a cut in more pieces");
}

void McmFolder::write(const RankPiece& piece, const RunOptions& options) {
  ranks_.inFirst([&] { make(); });
  ranks_.together([&] { writeOutput(pieceName(ranks_.rank()), [&](const Sink& sink) { writeMcm(sink, piece, options); }); });
  isComplete_ = true;
}

}  // namespace mandoline::cli
