// The processes that run a command together.
#pragma once

#include "mpi/communicator.h"

namespace mandoline::cli {

/// Thrown in all processes when one of them has said why it can't go on.
struct Stopped {
  int exitCode;
};

/// Waiting ends with Interrupted when a signal comes.
class Ranks {
 public:
  Ranks();

  bool isFirst() const { return comm_.rank() == 0; }
  int rank() const { return comm_.rank(); }
  int size() const { return comm_.size(); }
  /// How many of them share this machine.
  int onThisMachine() const;
  detail::Communicator& comm() { return comm_; }

  /// Runs work() in all. If that fails in some, the lowest of them says why, and all throw Stopped.
  void together(detail::FunctionRef<void()> work);
  /// The same in the first alone.
  void inFirst(detail::FunctionRef<void()> work);

 private:
  detail::Communicator comm_;
};

/// Says what an exception means, as the program does when it ends with it; "rank R: " comes before what only one process may have met.
/// Gives the exit code. Interrupted and Stopped pass through.
int complainOfException(int rank);

}  // namespace mandoline::cli
