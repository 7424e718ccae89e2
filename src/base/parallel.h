// Loops over items on all threads, with results in item order, progress and cancelling.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace mandoline::detail {

/// Thrown where the progress callback returned false.
struct Cancelled {};
/// Thrown where the progress callback threw; kept apart from what the library itself throws, so that it can pass through unchanged.
struct ProgressFailed {
  std::exception_ptr exception;
};

/// Progress, cancelling and the number of threads: what a stage gets to see of the caller's options.
class Monitor {
 public:
  /// `options` are RunOptions, which must outlive the monitor.
  template <class RunOptions>
  Monitor(const RunOptions& options, int stageCount)
      : stageCount_(stageCount), threads_(std::clamp(options.threads ? options.threads : std::thread::hardware_concurrency(), 1u, 256u)) {
    if (!options.progress) return;
    callback_ = [&options, this](size_t done, size_t total) { return options.progress({stage_, index_, stageCount_, done, total}); };
  }
  Monitor(const Monitor&) = delete;

  void beginStage(const char* name, int index) {
    stage_ = name;
    index_ = index;
    report(0, 1);
  }
  /// Tells the callback (calls from several threads take turns); throws Cancelled or ProgressFailed if it wants no more.
  void report(size_t done, size_t total) {
    if (!callback_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (cancelled_ || !goOn(done, total)) {
      cancelled_ = true;
      throw Cancelled();
    }
  }
  unsigned threads() const { return threads_; }

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
  std::mutex mutex_;
  const char* stage_ = "";
  int index_ = 0, stageCount_;
  unsigned threads_;
  bool cancelled_ = false;
};

/// Runs f(state, begin, end) over 0..n in order of items, each State over one contiguous range, and returns the states in that order:
/// concatenating them gives the same result for any number of threads. `block` items lie between two reports, and more are worth a thread.
/// Of several failures the first in item order is thrown, but
/// ProgressFailed before any other.
template <class State, class F>
std::vector<State> forChunks(size_t n, Monitor& monitor, const F& f, size_t block = 2048) {
  const unsigned threads = n < block ? 1 : monitor.threads();
  const size_t chunks = threads == 1 ? 1 : 8 * threads;
  std::vector<State> states(chunks);
  std::vector<std::exception_ptr> failures(chunks);
  std::exception_ptr progressFailure;
  std::atomic<size_t> nextChunk{0}, done{0};
  std::atomic<bool> failed{false};
  const auto work = [&] {
    for (size_t c; !failed && (c = nextChunk++) < chunks;) {
      try {
        for (size_t begin = n * c / chunks, end = n * (c + 1) / chunks; begin < end;) {
          const size_t stop = std::min(end, begin + block);
          f(states[c], begin, stop);
          monitor.report(done += stop - begin, n);
          begin = stop;
        }
      } catch (const ProgressFailed&) {  // the callback is not called again, so there is one at most
        progressFailure = std::current_exception();
        failed = true;
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
  if (progressFailure) std::rethrow_exception(progressFailure);
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return states;
}

}  // namespace mandoline::detail
