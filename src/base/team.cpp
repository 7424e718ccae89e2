#include "base/team.h"

#include <atomic>

#ifndef MANDOLINE_ONE_THREAD
#include <algorithm>
#include <condition_variable>
#include <exception>
#include <vector>

#include "base/large_array.h"
#endif

namespace mandoline::detail {

#ifdef MANDOLINE_ONE_THREAD
struct Team::Crew {};
Team::Team(unsigned) : size_(1) {}
void Team::makeRoomInHeaps() const {}
void Team::run(size_t, FunctionRef<void(size_t)> work) const { work(0); }
#else
/// The other threads.
struct Team::Crew {
  std::mutex mutex;
  std::condition_variable called, left;
  std::vector<std::thread> threads;
  const FunctionRef<void(size_t)>* work = nullptr;
  std::atomic<size_t> wanted{0};  ///< how many more may begin
  std::atomic<size_t> inside{0};  ///< how many are at work
  std::atomic<bool> isOver{false};
  std::atomic<bool> isCalled{false};
  bool canStart = true;  ///< as far as is known
  std::atomic<bool> needsRoom{false};

  ~Crew() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      isOver = true;
    }
    called.notify_all();
    for (std::thread& thread : threads) thread.join();
  }

  /// Looks for a short time whether the next loop, or the end of one, comes at once, which is quicker than to sleep.
  template <class IsSo>
  static void watch(const IsSo& isSo) {
    constexpr int kLooks = 1000;
    for (int i = 0; i < kLooks && !isSo(); ++i) yieldThread();
  }

  void help(size_t thread) {
    const HeapBegin begin = needsRoom ? makeRoomInNewHeap() : nullptr;
    for (;;) {
      watch([&] { return wanted > 0 || isOver; });
      const FunctionRef<void(size_t)>* mine;
      {
        std::unique_lock<std::mutex> lock(mutex);
        called.wait(lock, [&] { return isOver || wanted > 0; });
        if (isOver) return;
        --wanted, ++inside;
        mine = work;
      }
      (*mine)(thread);
      const std::lock_guard<std::mutex> lock(mutex);
      if (--inside == 0) left.notify_one();
    }
  }

  void start(size_t count) {
    try {
      while (canStart && threads.size() < count) threads.emplace_back([this, thread = threads.size() + 1] { help(thread); });
    } catch (const std::exception&) {  // of the system or memory: the existing ones do the work
      canStart = false;
    }
  }

  void run(size_t others, const FunctionRef<void(size_t)>& ofAll) {
    if (isCalled.exchange(true)) return ofAll(0);
    start(others);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      work = &ofAll;
      wanted = others;
    }
    called.notify_all();
    ofAll(0);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      wanted = 0;
    }
    watch([&] { return inside == 0; });
    std::unique_lock<std::mutex> lock(mutex);
    left.wait(lock, [&] { return inside == 0; });
    isCalled = false;
  }
};

Team::Team(unsigned threads) : size_(threads), crew_(threads > 1 ? std::make_unique<Crew>() : nullptr) {}

void Team::makeRoomInHeaps() const {
  if (!crew_) return;
  crew_->needsRoom = true;
  crew_->start(size_ - 1);
}

void Team::run(size_t threads, FunctionRef<void(size_t)> work) const {
  if (std::min<size_t>(threads, size_) <= 1) return work(0);
  crew_->run(std::min<size_t>(threads, size_) - 1, work);
}
#endif

Team::~Team() = default;

void runOnParts(size_t parts, unsigned threads, FunctionRef<void(size_t)> work) {
  std::atomic<size_t> next{0};
  Team(threads).run(parts, [&](size_t) {
    for (size_t part; (part = next++) < parts;) work(part);
  });
}

}  // namespace mandoline::detail
