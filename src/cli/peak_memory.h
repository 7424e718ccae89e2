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

}  // namespace mandoline::cli
