// A file of each process.
#pragma once

#include <functional>

#include "cli/interrupt.h"
#include "cli/mpi/ranks.h"
#include "mandoline/io.h"

namespace mandoline::cli {

/// Files that go unless all are written.
class RankFiles {
 public:
  /// `nameOf`: the file of a process.
  RankFiles(Ranks& ranks, std::function<std::string(int)> nameOf);
  ~RankFiles();
  RankFiles(const RankFiles&) = delete;

  /// Writes this process's, if `isWritten`. Collective. Throws Stopped.
  void write(bool isWritten, const std::function<void(const Sink&)>& write);
  /// Once all that belongs together is written: the files stay.
  void complete() { isComplete_ = true; }

 private:
  const DeferInterrupts defer_;  // which would leave files
  Ranks& ranks_;
  const std::function<std::string(int)> nameOf_;
  bool isComplete_ = false;
};

}  // namespace mandoline::cli
