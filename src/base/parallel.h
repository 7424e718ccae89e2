// Loops over items on all threads, with results in item order, progress and cancelling.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <vector>

#include "base/function_ref.h"
#include "base/shared.h"
#include "base/team.h"

namespace mandoline::detail {

/// Thrown where the progress callback returned false.
struct MANDOLINE_SHARED Cancelled {};
/// Thrown where the progress callback threw; kept apart from what the library itself throws, so that it can pass through unchanged.
struct MANDOLINE_SHARED ProgressFailed {
  std::exception_ptr exception;
};

/// Progress, cancelling and the number of threads: all that the work itself sees of the caller's options.
class Monitor {
 public:
  /// `options` are RunOptions, which must outlive the monitor.
  template <class RunOptions>
  Monitor(const RunOptions& options, int stageCount) : Monitor(options.threads) {
    stageCount_ = stageCount;
    if (!options.progress) return;
    callback_ = [&options, this](size_t done, size_t total) { return options.progress({stage_, index_, stageCount_, done, total}); };
  }
  /// Of work that tells nobody; 0: as many threads as there are cores.
  explicit Monitor(unsigned threads) : team_(std::clamp(threads ? threads : coreCount(), 1u, 256u)) {}
  Monitor(const Monitor&) = delete;

  void beginStage(const char* name, int index) {
    stage_ = name;
    index_ = index;
    report(0, 1);
  }
  /// Tells the callback (calls from several threads take turns); throws Cancelled or ProgressFailed if it wants no more.
  void report(size_t done, size_t total) {
    if (!callback_) return;
    const std::lock_guard<Mutex> lock(mutex_);
    if (cancelled_ || !goOn(done, total)) {
      cancelled_ = true;
      throw Cancelled();
    }
  }
  unsigned threads() const { return team_.size(); }
  /// Those of all loops.
  const Team& team() const { return team_; }

  /// The options for one of the calls that this call is made of, which must not outlive the monitor. The stages of that call come after
  /// `before` others and before `after`.
  template <class Options>
  Options part(int before, int after) {
    Options options;
    options.threads = threads();
    if (!callback_) return options;
    options.progress = [this, before, after](const auto& progress) {
      stage_ = progress.stage;
      index_ = before + progress.stageIndex;
      stageCount_ = before + progress.stageCount + after;
      return goOn(progress.done, progress.total);
    };
    return options;
  }

 private:
  bool goOn(size_t done, size_t total) {
    try {
      return callback_(done, total);
    } catch (...) {
      cancelled_ = true;
      throw ProgressFailed{std::current_exception()};
    }
  }

  std::function<bool(size_t, size_t)> callback_;
  Mutex mutex_;
  const char* stage_ = "";
  int index_ = 0, stageCount_ = 1;
  const Team team_;
  bool cancelled_ = false;
};

/// How many ranges forChunks makes of n items.
inline size_t chunkCount(size_t n, const Monitor& monitor, size_t block) {
  const unsigned threads = n < block ? 1 : monitor.threads();
  return threads == 1 ? 1 : 8 * threads;
}

/// Runs f(chunk, begin, end) for that many ranges of 0..n, as forChunks below.
MANDOLINE_SHARED void runChunks(size_t n, size_t chunks, Monitor& monitor, FunctionRef<void(size_t, size_t, size_t)> f, size_t block);

/// Runs f(state, begin, end) over 0..n in order of items, each State over one contiguous range, and returns the states in that order:
/// concatenating them gives the same result for any number of threads. Progress is reported every `block` items, and fewer items are not
/// worth a thread. Of several failures the first in item order is thrown, but ProgressFailed before any other.
template <class State, class F>
std::vector<State> forChunks(size_t n, Monitor& monitor, const F& f, size_t block = 2048) {
  const size_t chunks = chunkCount(n, monitor, block);
#ifdef MANDOLINE_ONE_THREAD
  std::vector<State> states(chunks);
  runChunks(
      n, chunks, monitor, [&](size_t chunk, size_t begin, size_t end) { f(states[chunk], begin, end); }, block);
#else
  struct alignas(128) Apart {  // in cache lines of their own: threads write to states beside each other at the same time
    State state{};
  };
  std::vector<Apart> apart(chunks);
  runChunks(
      n, chunks, monitor, [&](size_t chunk, size_t begin, size_t end) { f(apart[chunk].state, begin, end); }, block);
  std::vector<State> states;
  states.reserve(chunks);
  for (Apart& of : apart) states.push_back(std::move(of.state));
#endif
  return states;
}

/// Runs f(thread, item) for each item of `order`, in that order, on all threads; `thread` counts from 0 to below monitor.threads(), and no
/// two run with the same one at once. Of several failures that of the lowest item is thrown, but ProgressFailed before any other.
MANDOLINE_SHARED void runItems(const std::vector<uint32_t>& order, Monitor& monitor, FunctionRef<void(size_t, uint32_t)> f);

}  // namespace mandoline::detail
