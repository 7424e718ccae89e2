#include "base/parallel.h"

#include <atomic>

namespace mandoline::detail {

namespace {

/// What went wrong in a loop on several threads.
class Failures {
 public:
  /// To be called in a handler, by any thread.
  void note(size_t item) {
    const std::lock_guard<Mutex> lock(mutex_);
    try {
      throw;
    } catch (const ProgressFailed&) {
      item_ = 0;  // nothing else counts any more
      isProgress_ = true;
      exception_ = std::current_exception();
    } catch (...) {
      if (isProgress_ || item >= item_) return;
      item_ = item;
      exception_ = std::current_exception();
    }
  }
  /// Whether an item before this one, or this one, has failed.
  bool isBehind(size_t item) const { return item >= item_; }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  Mutex mutex_;
  std::atomic<size_t> item_{SIZE_MAX};
  bool isProgress_ = false;
  std::exception_ptr exception_;
};

}  // namespace

void runChunks(size_t n, size_t chunks, Monitor& monitor, FunctionRef<void(size_t, size_t, size_t)> f, size_t block) {
  Failures failures;
  std::atomic<size_t> next{0}, done{0};
  // Threads are far from each other: else they would wait for the same new pages and write to the same cache lines, and one's part of
  // the items would be another's in the next loop.
  const size_t parts = monitor.threads(), step = (chunks + parts - 1) / parts;
  monitor.team().run(chunks, [&] {
    for (size_t i; (i = next++) < step * parts;) {
      const size_t c = i % parts * step + i / parts;
      if (c >= chunks || failures.isBehind(c)) continue;
      try {
        for (size_t begin = n * c / chunks, end = n * (c + 1) / chunks; begin < end;) {
          const size_t stop = std::min(end, begin + block);
          f(c, begin, stop);
          monitor.report(done += stop - begin, n);
          begin = stop;
        }
      } catch (...) {
        failures.note(c);
      }
    }
  });
  failures.rethrow();
}

void runItems(const std::vector<uint32_t>& order, Monitor& monitor, FunctionRef<void(size_t, uint32_t)> f) {
  Failures failures;
  std::atomic<size_t> next{0}, done{0}, nextThread{0};
  monitor.team().run(order.size(), [&] {
    const size_t thread = nextThread++;
    for (size_t i; (i = next++) < order.size();) {
      const uint32_t item = order[i];
      if (failures.isBehind(item)) continue;  // those before the first that failed have yet to show whether they do
      try {
        f(thread, item);
        monitor.report(++done, order.size());
      } catch (...) {
        failures.note(item);
      }
    }
  });
  failures.rethrow();
}

}  // namespace mandoline::detail
