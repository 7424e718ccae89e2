// Threads that many short loops share one after the other: starting threads for each would take as long as some of the loops.
#pragma once

#include <cstddef>
#include <memory>

#include "base/function_ref.h"
#include "base/shared.h"
#include "base/threads.h"

namespace mandoline::detail {

class MANDOLINE_SHARED Team {
 public:
  /// So many threads, at least 1: the caller's and others, which are started once they are needed. Implicit, so that what takes a team for
  /// its loops can also be called with a number of threads.
  Team(unsigned threads);  // NOLINT
  Team(const Team&) = delete;
  ~Team();

#ifdef MANDOLINE_ONE_THREAD
  unsigned size() const { return 1; }  // known here, what is for several threads is left out
#else
  unsigned size() const { return size_; }
#endif

  /// Runs work(thread), which must not throw, here, which is thread 0, and on others of at most `threads` of them in all; each has its
  /// own number below size(). Once it has returned here there must be nothing left to begin: those which have not begun by then are not
  /// waited for. A call during another one has none of the others.
  void run(size_t threads, FunctionRef<void(size_t)> work) const;

  /// Starts its other threads, which begin by making room in their heaps: see makeRoomInHeap().
  void makeRoomInHeaps() const;

 private:
  struct Crew;
  [[maybe_unused]] unsigned size_;
  std::unique_ptr<Crew> crew_;
};

/// Runs work(part), which must not throw, for each of that many parts, on that many threads of its own.
MANDOLINE_SHARED void runOnParts(size_t parts, unsigned threads, FunctionRef<void(size_t)> work);

}  // namespace mandoline::detail
