// Sorting, with little code for each type and the same order of equal items on every platform.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "base/function_ref.h"
#include "base/shared.h"

namespace mandoline::detail {

/// Sorts items that are moved as bytes, stably.
MANDOLINE_SHARED void sortMany(void* items, size_t count, size_t itemSize, FunctionRef<bool(const void*, const void*)> isBefore);

/// Sorts a vector, array or span, stably.
template <class Items, class IsBefore = std::less<>>
void sortItems(Items&& items, const IsBefore& isBefore = {}) {
  constexpr size_t kFew = 32;
  using Item = std::remove_reference_t<decltype(*items.data())>;
  static_assert(std::is_trivially_copy_constructible_v<Item> && std::is_trivially_destructible_v<Item>);
  Item* const first = items.data();
  const size_t count = items.size();
  if (count > kFew) {
    const auto byAddress = [&](const void* a, const void* b) {
      return isBefore(*static_cast<const Item*>(a), *static_cast<const Item*>(b));
    };
    return sortMany(first, count, sizeof(Item), byAddress);
  }
  for (size_t i = 1; i < count; ++i) {
    const Item item = first[i];
    size_t j = i;
    for (; j > 0 && isBefore(item, first[j - 1]); --j) first[j] = first[j - 1];
    first[j] = item;
  }
}

/// The same by keyOf(item) first, a number below `keys`. Quicker where few items have the same.
template <class Item, class KeyOf, class IsBefore>
void sortByKeys(std::vector<Item>& items, size_t keys, const KeyOf& keyOf, const IsBefore& isBefore) {
  std::vector<size_t> starts(keys + 1, 0);
  for (const Item& item : items) ++starts[keyOf(item) + 1];
  for (size_t key = 0; key < keys; ++key) starts[key + 1] += starts[key];
  std::vector<Item> sorted(items.size());
  for (const Item& item : items) sorted[starts[keyOf(item)]++] = item;  // now they are where the next key starts
  for (size_t key = 0, begin = 0; key < keys; begin = starts[key++]) {
    if (starts[key] - begin > 1) sortItems(std::span<Item>(sorted.data() + begin, starts[key] - begin), isBefore);
  }
  items = std::move(sorted);
}

/// Sorts a vector and keeps each of equal items once.
template <class Item, class IsBefore = std::less<>>
void sortUnique(std::vector<Item>& items, const IsBefore& isBefore = {}) {
  sortItems(items, isBefore);
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// As std::partition_point(), quicker where that is near the beginning.
template <class Iterator, class IsBefore>
Iterator partitionPointAhead(Iterator first, Iterator past, const IsBefore& isBefore) {
  ptrdiff_t step = 1;
  for (; step < past - first && isBefore(first[step]); step *= 2) first += step;
  return std::partition_point(first, first + std::min(step, past - first), isBefore);
}

}  // namespace mandoline::detail
