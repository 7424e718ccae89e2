// What the programs may take of the machine's memory.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

// Sanitizers reserve more memory than a machine has. GCC and clang have different macros for them.
#if defined(__SANITIZE_ADDRESS__)
#define MANDOLINE_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MANDOLINE_SANITIZED
#endif
#endif

namespace mandoline::cli {

/// Lets allocations beyond the machine's memory fail, so that a cut that is too large ends with a status instead of being killed. Of
/// several processes on the machine each gets its share.
inline void limitMemory([[maybe_unused]] int processes = 1) {
#if !defined(MANDOLINE_SANITIZED) && defined(_SC_PHYS_PAGES)
  const long pages = sysconf(_SC_PHYS_PAGES), pageSize = sysconf(_SC_PAGESIZE);
  rlimit limit{};
  if (pages <= 0 || pageSize <= 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const rlim_t most = rlim_t(pages) / 10 * 9 * rlim_t(pageSize) / rlim_t(processes);
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

}  // namespace mandoline::cli
