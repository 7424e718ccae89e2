#include "base/large_array.h"

#include <algorithm>
#include <cstdint>

#include "base/team.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace mandoline::detail {

#if defined(__linux__) && defined(MADV_POPULATE_WRITE)

namespace {

constexpr uintptr_t kPage = uintptr_t(1) << 12, kLargePage = kPageAlignment;
/// Fewer bytes are not worth the call.
constexpr uintptr_t kFew = 16 * kPage;

uintptr_t roundedUp(uintptr_t at, uintptr_t page) { return (at + page - 1) & ~(page - 1); }

void advise(uintptr_t begin, uintptr_t end, int advice) {
  if (begin + kFew <= end) madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}

}  // namespace

void preferLargePages(void* begin, size_t bytes) {
  const uintptr_t at = reinterpret_cast<uintptr_t>(begin);
  advise(roundedUp(at, kLargePage), (at + bytes) & ~(kLargePage - 1), MADV_HUGEPAGE);
}

void getPages(void* begin, size_t bytes) {
  const uintptr_t at = reinterpret_cast<uintptr_t>(begin);
  preferLargePages(begin, bytes);
  advise(roundedUp(at, kPage), (at + bytes) & ~(kPage - 1), MADV_POPULATE_WRITE);
}

void getPages(void* begin, size_t bytes, unsigned threads) {
  constexpr size_t kSlice = 8 * kPageAlignment;
  const auto first = reinterpret_cast<uintptr_t>(begin), past = first + bytes;
  const size_t slices = past / kSlice - first / kSlice + 1;
  runOnParts(slices, unsigned(std::min<size_t>(slices, threads)), [&](size_t slice) {
    const uintptr_t from = std::max(first, (first / kSlice + slice) * kSlice), to = std::min(past, (first / kSlice + slice + 1) * kSlice);
    getPages(reinterpret_cast<void*>(from), to - from);
  });
}

#else

void preferLargePages(void*, size_t) {}
void getPages(void*, size_t) {}
void getPages(void*, size_t, unsigned) {}

#endif

#ifdef __GLIBC__
void giveBackFreed() { malloc_trim(0); }
#else
void giveBackFreed() {}
#endif

}  // namespace mandoline::detail
