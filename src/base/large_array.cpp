#include "base/large_array.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

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

void* takeLargePages(size_t bytes) {
  void* const mapped = mmap(nullptr, bytes + kLargePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  const uintptr_t at = reinterpret_cast<uintptr_t>(mapped), pages = roundedUp(at, kLargePage), past = pages + bytes;
  if (pages > at) munmap(mapped, pages - at);
  if (past < at + bytes + kLargePage) munmap(reinterpret_cast<void*>(past), at + kLargePage - pages);
  preferLargePages(reinterpret_cast<void*>(pages), bytes);
  return reinterpret_cast<void*>(pages);
}

void giveBackLargePages(void* pages, size_t bytes) { munmap(pages, bytes); }

#else

void preferLargePages(void*, size_t) {}
void getPages(void*, size_t) {}
void getPages(void*, size_t, unsigned) {}
void* takeLargePages(size_t bytes) { return ::operator new (bytes, std::align_val_t{kPageAlignment}); }
void giveBackLargePages(void* pages, size_t) { ::operator delete (pages, std::align_val_t{kPageAlignment}); }

#endif

#if defined(__GLIBC__) && defined(MADV_POPULATE_WRITE)

void makeRoomInHeap() {
  constexpr size_t kRoom = size_t(31) << 20;  // what is larger never lies in the heap
  // The first one comes from the system, but once that is freed the next lies in the heap, and, when it is freed, stays at the heap's end.
  for (int i = 0; i < 2; ++i) {
    void* const room = std::malloc(kRoom);
    if (!room) return;
    preferLargePages(room, kRoom);
    std::free(room);
  }
}

HeapBegin makeRoomInNewHeap() {
  constexpr size_t kLeast = 16, kHeader = 16;
  makeRoomInHeap();
  const HeapBegin first(std::malloc(kLeast));
  const uintptr_t at = reinterpret_cast<uintptr_t>(first.get()), past = roundedUp(at, kLargePage);
  return HeapBegin(past - at > kFew ? std::malloc(past - at + kHeader) : nullptr);
}

#else

void makeRoomInHeap() {}
HeapBegin makeRoomInNewHeap() { return nullptr; }

#endif

#ifdef __GLIBC__
void giveBackFreed() { malloc_trim(0); }
#else
void giveBackFreed() {}
#endif

}  // namespace mandoline::detail
