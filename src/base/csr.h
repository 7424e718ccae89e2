// Offsets + items, filled by count, scan, fill.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace mandoline::detail {

/// Groups of items: group g holds items[offsets[g]] .. items[offsets[g + 1] - 1].
template <class Item>
struct Csr {
  std::vector<uint32_t> offsets{0};
  std::vector<Item> items;

  size_t size() const { return offsets.size() - 1; }
  std::span<const Item> operator[](size_t g) const { return {items.data() + offsets[g], offsets[g + 1] - offsets[g]}; }
  std::span<Item> operator[](size_t g) { return {items.data() + offsets[g], offsets[g + 1] - offsets[g]}; }
};

/// Groups n items by groupOf(i); item(i) is stored. The order within a group is that of i.
template <class Item, class GroupOf, class ItemOf>
Csr<Item> groupBy(size_t groups, size_t n, const GroupOf& groupOf, const ItemOf& itemOf) {
  Csr<Item> csr;
  csr.offsets.assign(groups + 1, 0);
  for (size_t i = 0; i < n; ++i) ++csr.offsets[groupOf(i) + 1];
  for (size_t g = 0; g < groups; ++g) csr.offsets[g + 1] += csr.offsets[g];
  csr.items.resize(n);
  std::vector<uint32_t> at(csr.offsets.begin(), csr.offsets.end() - 1);
  for (size_t i = 0; i < n; ++i) csr.items[at[groupOf(i)]++] = itemOf(i);
  return csr;
}

struct KeyedItem {
  uint64_t key;
  uint32_t item;
};

/// Sorts by key, stably: radix sort in as many passes as the largest key needs.
inline void sortByKey(std::vector<KeyedItem>& items, uint64_t largestKey) {
  constexpr int kBits = 11;
  std::vector<KeyedItem> other(items.size());
  for (int shift = 0; shift < 64 && (largestKey >> shift) != 0; shift += kBits) {
    uint32_t at[(1 << kBits) + 1] = {};
    const auto digit = [shift](const KeyedItem& k) { return (k.key >> shift) & ((1 << kBits) - 1); };
    for (const KeyedItem& k : items) ++at[digit(k) + 1];
    for (int d = 0; d < (1 << kBits); ++d) at[d + 1] += at[d];
    for (const KeyedItem& k : items) other[at[digit(k)]++] = k;
    items.swap(other);
  }
}

}  // namespace mandoline::detail
