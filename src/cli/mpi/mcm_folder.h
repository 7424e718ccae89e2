// A folder with a .mcm file of each process.
#pragma once

#include "cli/interrupt.h"
#include "cli/mpi/ranks.h"
#include "mandoline/io.h"

namespace mandoline::cli {

/// Whether the output is such a folder: FOLDER.mcm/.
bool isMcmFolder(const std::string& path);

/// Files that go unless all are written.
class McmFolder {
 public:
  /// `path` is one of isMcmFolder().
  McmFolder(Ranks& ranks, std::string path);
  ~McmFolder();
  McmFolder(const McmFolder&) = delete;

  /// Writes this process's piece. Collective. Throws Stopped, also where the folder has a piece of a cut in more processes.
  void write(const RankPiece& piece, const RunOptions& options);

 private:
  std::string pieceName(int rank) const { return path_ + "piece_" + std::to_string(rank) + ".mcm"; }
  void make();

  const DeferInterrupts defer_;  // which would leave files
  Ranks& ranks_;
  const std::string path_;
  bool isComplete_ = false;
};

}  // namespace mandoline::cli
