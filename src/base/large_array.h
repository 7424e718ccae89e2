// Memory of large arrays. Touched for the first time page by page, it takes longer than what is then written into it, above all in virtual
// machines; so the system is asked for it in large pages, where it has such, and otherwise for many pages at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/shared.h"

namespace mandoline::detail {

/// Where large pages begin, if there are such.
#ifdef __linux__
inline constexpr bool kHasLargePages = true;
inline constexpr size_t kPageAlignment = size_t(1) << 21;
#else
inline constexpr bool kHasLargePages = false;
inline constexpr size_t kPageAlignment = 16;
#endif

/// Asks for large pages in memory that is going to be written to. Nothing happens where the system can't.
MANDOLINE_SHARED void preferLargePages(void* begin, size_t bytes);
/// The same, and gets all of its pages. Meanwhile no thread gets other memory from the system: where many threads do, touch it instead.
MANDOLINE_SHARED void getPages(void* begin, size_t bytes);
/// The same on several threads.
MANDOLINE_SHARED void getPages(void* begin, size_t bytes, unsigned threads);

/// Makes room at the end of this thread's heap, in large pages, which are got once they are touched: small and middling arrays that come
/// next lie there. Nothing happens where the system can't.
MANDOLINE_SHARED void makeRoomInHeap();

struct FreeHeap {
  void operator()(void* begin) const { std::free(begin); }
};
using HeapBegin = std::unique_ptr<void, FreeHeap>;
/// The same for a thread that has just begun. Gives the memory before the first large page of its heap, for the thread to keep: it would
/// be got in small pages, one by one.
HeapBegin makeRoomInNewHeap();

/// As much, or more, as a multiple of kPageAlignment.
constexpr size_t inWholePages(size_t bytes) { return (bytes + kPageAlignment - 1) / kPageAlignment * kPageAlignment; }

/// That much memory, of which large pages come first, and which goes back to the system at once: in the heap, holes of that size would
/// stay. `bytes` are a multiple of kPageAlignment.
MANDOLINE_SHARED void* takeLargePages(size_t bytes);
MANDOLINE_SHARED void giveBackLargePages(void* pages, size_t bytes);

/// Leaves freed memory to the system that the allocator keeps for later, where it can; takes some milliseconds for each gigabyte.
void giveBackFreed();

/// Makes room in an empty array: an eighth more in one that has had too little, which is used again and again. Its pages are got later.
template <class Array>
void reserveUntouched(Array& items, size_t count) {
  items.reserve(items.capacity() > 0 ? count + count / 8 : count);
  preferLargePages(items.data(), count * sizeof(typename Array::value_type));
}

/// The same with its pages, where there is too little room.
template <class Array>
void reserveLarge(Array& items, size_t count) {
  if (items.capacity() >= count) return;
  reserveUntouched(items, count);
  getPages(items.data(), count * sizeof(typename Array::value_type));
}

/// Lengthens an array that has room for that many items, whose pages are got a few at a time, so that what is written into them here finds
/// them in the cache.
template <class Item>
void resizeInRoom(std::vector<Item>& items, size_t count) {
  constexpr size_t kStep = (size_t(1) << 18) / sizeof(Item);
  while (items.size() < count) {
    const size_t more = std::min(kStep, count - items.size());
    getPages(items.data() + items.size(), more * sizeof(Item));
    items.resize(items.size() + more);
  }
  items.resize(count);
}

/// Makes an empty array that long.
template <class Item>
void makeLarge(std::vector<Item>& items, size_t count, std::type_identity_t<Item> fill = {}) {
  reserveLarge(items, count);
  items.resize(count, fill);
}

/// The same where several threads will fill it: they also get the memory.
template <class Item>
void makeLargeOnThreads(std::vector<Item>& items, size_t count, unsigned threads) {
  items.reserve(count);
  getPages(items.data(), count * sizeof(Item), threads);
  items.resize(count);
}

/// Makes an empty array the same as another one.
template <class Array>
void copyLarge(const Array& from, Array& to) {
  reserveLarge(to, from.size());
  to.assign(from.begin(), from.end());
}

/// Allocator for arrays that are soon given back, and are written to before they are read: what is large comes in large pages, and items
/// start without a value.
template <class Item>
struct LargePages {
  using value_type = Item;

  LargePages() = default;
  template <class Other>
  LargePages(const LargePages<Other>&) {}

  Item* allocate(size_t count) {
    if (!isLarge(count)) return std::allocator<Item>().allocate(count);
    return static_cast<Item*>(takeLargePages(bytesOf(count)));
  }
  void deallocate(Item* items, size_t count) {
    if (!isLarge(count)) return std::allocator<Item>().deallocate(items, count);
    giveBackLargePages(items, bytesOf(count));
  }
  template <class Other>
  void construct(Other* item) {
    ::new (static_cast<void*>(item)) Other;
  }
  template <class Other, class... Arguments>
  void construct(Other* item, Arguments&&... arguments) {
    ::new (static_cast<void*>(item)) Other(std::forward<Arguments>(arguments)...);
  }
  bool operator==(const LargePages&) const { return true; }

 private:
  /// From half a large page on, a whole one comes sooner than small ones.
  static bool isLarge(size_t count) { return kHasLargePages && count >= kPageAlignment / 2 / sizeof(Item); }
  static size_t bytesOf(size_t count) { return inWholePages(count * sizeof(Item)); }
};

template <class Item>
using LargeVector = std::vector<Item, LargePages<Item>>;

/// An array that long, which begins with these items.
template <class Item>
std::vector<Item> longer(const std::vector<Item>& items, size_t count) {
  std::vector<Item> result;
  reserveUntouched(result, count);
  result.assign(items.begin(), items.end());
  resizeInRoom(result, count);
  return result;
}

}  // namespace mandoline::detail
