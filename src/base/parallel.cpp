#include "base/parallel.h"

#include <atomic>
#include <system_error>

namespace mandoline::detail {

void runChunks(size_t n, size_t chunks, Monitor& monitor, FunctionRef<void(size_t, size_t, size_t)> f, size_t block) {
  std::vector<std::exception_ptr> failures(chunks);
  std::exception_ptr progressFailure;
  std::atomic<size_t> nextChunk{0}, done{0};
  std::atomic<bool> failed{false};
  const auto work = [&] {
    for (size_t c; !failed && (c = nextChunk++) < chunks;) {
      try {
        for (size_t begin = n * c / chunks, end = n * (c + 1) / chunks; begin < end;) {
          const size_t stop = std::min(end, begin + block);
          f(c, begin, stop);
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
    for (unsigned i = 1; chunks > 1 && i < monitor.threads(); ++i) pool.emplace_back(work);
  } catch (const std::system_error&) {  // no more threads available: the existing ones do the work
  }
  work();
  for (std::thread& thread : pool) thread.join();
  if (progressFailure) std::rethrow_exception(progressFailure);
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace mandoline::detail
