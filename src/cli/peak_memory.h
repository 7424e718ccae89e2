// How much memory this process needed.
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace mandoline::cli {

/// The most that it has had so far.
inline size_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return size_t(usage.ru_maxrss);
#else
  return size_t(usage.ru_maxrss) * 1024;
#endif
}

/// What the processor has worked for it so far, in milliseconds, of all threads.
inline double processorMs() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto milliseconds = [](const timeval& time) { return 1e3 * double(time.tv_sec) + 1e-3 * double(time.tv_usec); };
  return milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
}

}  // namespace mandoline::cli
