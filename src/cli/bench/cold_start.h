// How a benchmarked process measures: its processor time, in memory that has not been used before.
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

/// Returns to the system the pages that reading a file has left free, where that is possible.
inline void returnFreePages() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace mandoline::bench
