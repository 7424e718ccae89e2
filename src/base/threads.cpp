#include "base/threads.h"

#include <atomic>
#include <system_error>
#include <vector>

namespace mandoline::detail {

#ifdef MANDOLINE_ONE_THREAD
void runOnThreads(size_t, FunctionRef<void(size_t)> work) { work(0); }
#else
void runOnThreads(size_t threads, FunctionRef<void(size_t)> work) {
  std::vector<std::thread> pool;
  try {
    for (size_t i = 1; i < threads; ++i) pool.emplace_back([&, i] { work(i); });
  } catch (const std::system_error&) {  // the existing ones do the work
  }
  work(0);
  for (std::thread& thread : pool) thread.join();
}
#endif

void runOnParts(size_t parts, size_t threads, FunctionRef<void(size_t)> work) {
  std::atomic<size_t> next{0};
  runOnThreads(threads, [&](size_t) {
    for (size_t part; (part = next++) < parts;) work(part);
  });
}

}  // namespace mandoline::detail
