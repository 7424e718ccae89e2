// What a benchmarked process measures with: its processor time, on memory that nothing has warmed.
#pragma once

#include <cstdlib>
#include <ctime>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace mandoline::bench {

inline double processorMs() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

/// Gives the pages back to the system that reading a file has left free, where that can be done.
inline void returnFreePages() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace mandoline::bench
