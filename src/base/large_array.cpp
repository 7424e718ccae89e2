#include "base/large_array.h"

#ifdef __linux__
#include <sys/mman.h>

#include <cstdint>
#endif

namespace mandoline::detail {

#ifdef __linux__
void askForLargePages(void* begin, size_t bytes) {
  constexpr uintptr_t kPage = uintptr_t(1) << 21;
  const uintptr_t first = (reinterpret_cast<uintptr_t>(begin) + kPage - 1) & ~(kPage - 1),
                  past = (reinterpret_cast<uintptr_t>(begin) + bytes) & ~(kPage - 1);
  if (first < past) madvise(reinterpret_cast<void*>(first), past - first, MADV_HUGEPAGE);
}
#else
void askForLargePages(void*, size_t) {}
#endif

}  // namespace mandoline::detail
