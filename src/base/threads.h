// Threads, if there are any. In WebAssembly without shared memory there is one, and the library's mutexes and threads would bring along the
// texts of all errors of the system.
#pragma once

#include <mutex>

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

}  // namespace mandoline::detail
