#include "cli/mpi/rank_files.h"

#include <filesystem>

#include "cli/files.h"

namespace mandoline::cli {

RankFiles::RankFiles(Ranks& ranks, std::function<std::string(int)> nameOf) : ranks_(ranks), nameOf_(std::move(nameOf)) {}

/// Those of all processes: one that was killed has left what it was writing.
RankFiles::~RankFiles() {
  if (isComplete_) return;
  std::error_code ignored;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    std::filesystem::remove(nameOf_(rank), ignored);
    std::filesystem::remove(nameOf_(rank) + ".part", ignored);
  }
}

void RankFiles::write(bool isWritten, const std::function<void(const Sink&)>& write) {
  ranks_.together([&] {
    if (isWritten) writeOutput(nameOf_(ranks_.rank()), write);
  });
}

}  // namespace mandoline::cli
