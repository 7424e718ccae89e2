// A .pvtu file and a .vtu file for each process, beside it.
#pragma once

#include "cli/interrupt.h"
#include "cli/mpi/ranks.h"
#include "mandoline/distributed.h"
#include "mandoline/io.h"

namespace mandoline::cli {

bool isPvtu(const std::string& path);

/// Files that go unless all are written.
class PieceFiles {
 public:
  /// `path` ends with ".pvtu".
  PieceFiles(Ranks& ranks, std::string path);
  ~PieceFiles();
  PieceFiles(const PieceFiles&) = delete;

  /// Writes this process's file, unless it would have no cells, and the first process the one that joins them. Collective. Throws Stopped.
  void write(const MeshView& mesh, const RankPiece& piece, const WriteOptions& options);

 private:
  std::string pieceName(int rank) const;

  const DeferInterrupts defer_;  // which would leave files
  Ranks& ranks_;
  const std::string path_;
  bool isComplete_ = false;
};

}  // namespace mandoline::cli
