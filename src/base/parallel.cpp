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

/// Gives threads the numbers below `count`, each once: to each every so many, and once these are gone, those of others. So the same thread
/// mostly works on the same part of the data in one loop after the other, which is then in its cache, and threads wait for each other less
/// for new pages and cache lines.
class Shares {
 public:
  Shares(size_t count, size_t threads) : count_(count), next_(std::min(count, threads)) {
    for (size_t i = 0; i < next_.size(); ++i) next_[i].number = i;
  }

  /// The next one for a thread, or one that is not below `count`.
  size_t next(size_t thread) {
    for (size_t i = 0; i < next_.size(); ++i) {
      std::atomic<size_t>& next = next_[(thread + i) % next_.size()].number;
      if (next >= count_) continue;
      const size_t number = next.fetch_add(next_.size());
      if (number < count_) return number;
    }
    return count_;
  }

 private:
  struct alignas(128) Next {  // in a cache line of its own
    std::atomic<size_t> number;
  };
  const size_t count_;
  std::vector<Next> next_;
};

}  // namespace

void runChunks(size_t n, size_t chunks, Monitor& monitor, FunctionRef<void(size_t, size_t, size_t)> f, size_t block) {
  Failures failures;
  std::atomic<size_t> done{0};
  const size_t threads = monitor.threads(), step = (chunks + threads - 1) / threads;  // chunks beside each other are of one thread
  Shares shares(step * threads, threads);
  monitor.team().run(chunks, [&](size_t thread) {
    for (size_t i; (i = shares.next(thread)) < step * threads;) {
      const size_t c = i % threads * step + i / threads;
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
  std::atomic<size_t> done{0};
  Shares shares(order.size(), monitor.threads());
  monitor.team().run(order.size(), [&](size_t thread) {
    for (size_t i; (i = shares.next(thread)) < order.size();) {
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
