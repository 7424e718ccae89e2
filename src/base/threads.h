// Threads, if there are any. In WebAssembly without shared memory there is one, and the library's mutexes and threads would bring along the
// texts of all errors of the system.
#pragma once

#include <cstddef>
#include <mutex>

#include "base/function_ref.h"
#include "base/shared.h"

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
#define MANDOLINE_ONE_THREAD
#else
#include <thread>
#endif

namespace mandoline::detail {

#ifdef MANDOLINE_ONE_THREAD
struct Mutex {
  void lock() {}
  void unlock() {}
};
inline unsigned coreCount() { return 1; }
inline void yieldThread() {}
#else
using Mutex = std::mutex;
inline unsigned coreCount() { return std::thread::hardware_concurrency(); }
inline void yieldThread() { std::this_thread::yield(); }
#endif

/// Runs work(thread) on that many threads, or on fewer where there are no more.
MANDOLINE_SHARED void runOnThreads(size_t threads, FunctionRef<void(size_t)> work);

/// Runs work(part), which must not throw, for each of that many parts.
MANDOLINE_SHARED void runOnParts(size_t parts, size_t threads, FunctionRef<void(size_t)> work);

}  // namespace mandoline::detail
