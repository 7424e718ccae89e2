// Loops over items on all threads, with results in item order, progress and cancelling.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "mandoline/mandoline.h"

namespace mandoline::detail {

/// What ends a cut early; caught by cut() alone.
struct Failure {
  Error error;
};

/// Progress, cancelling and the number of threads: what every stage gets to see of the caller's options.
class Monitor {
 public:
  Monitor(const CutOptions& options, int stageCount)
      : callback_(options.progress),
        stageCount_(stageCount),
        threads_(options.threads ? options.threads : std::thread::hardware_concurrency()) {
    threads_ = std::clamp(threads_, 1u, 256u);
  }

  void beginStage(const char* name, int index) {
    stage_ = name;
    index_ = index;
    report(0, 1);
  }
  /// Tells the callback (calls from several threads take turns); throws Failure if it cancels.
  void report(size_t done, size_t total) {
    if (!callback_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (cancelled_ || !callback_({stage_, index_, stageCount_, done, total})) {
      cancelled_ = true;
      throw Failure{{Status::cancelled, -1, -1, "The cut was cancelled."}};
    }
  }
  unsigned threads() const { return threads_; }

 private:
  const std::function<bool(const Progress&)>& callback_;
  std::mutex mutex_;
  const char* stage_ = "";
  int index_ = 0, stageCount_;
  unsigned threads_;
  bool cancelled_ = false;
};

/// Runs f(state, begin, end) over 0..n in order of items, each State over one contiguous range, and returns the states in that order:
/// concatenating them gives the same result for any number of threads. The first failure in item order is thrown.
template <class State, class F>
std::vector<State> forChunks(size_t n, Monitor& monitor, const F& f) {
  constexpr size_t kBlock = 2048;  // items between two reports
  const unsigned threads = n < kBlock ? 1 : monitor.threads();
  const size_t chunks = threads == 1 ? 1 : 8 * threads;
  std::vector<State> states(chunks);
  std::vector<std::exception_ptr> failures(chunks);
  std::atomic<size_t> nextChunk{0}, done{0};
  std::atomic<bool> failed{false};
  const auto work = [&] {
    for (size_t c; !failed && (c = nextChunk++) < chunks;) {
      try {
        for (size_t begin = n * c / chunks, end = n * (c + 1) / chunks; begin < end;) {
          const size_t stop = std::min(end, begin + kBlock);
          f(states[c], begin, stop);
          monitor.report(done += stop - begin, n);
          begin = stop;
        }
      } catch (...) {
        failures[c] = std::current_exception();
        failed = true;
      }
    }
  };
  std::vector<std::thread> pool;
  try {
    for (unsigned i = 1; i < threads; ++i) pool.emplace_back(work);
  } catch (const std::system_error&) {  // no more threads to be had: those there are do the work
  }
  work();
  for (std::thread& thread : pool) thread.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return states;
}

}  // namespace mandoline::detail
