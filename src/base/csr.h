// Offsets + items, filled by count, scan, fill.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/id.h"
#include "base/sort.h"

namespace mandoline::detail {

/// Appends the groups that other offsets describe, so that they start after the last one here.
inline void appendOffsets(std::vector<uint32_t>& offsets, const std::vector<uint32_t>& more) {
  const uint32_t shift = offsets.back();
  for (size_t i = 1; i < more.size(); ++i) offsets.push_back(more[i] + shift);
}

/// Some groups of a Csr, one after the other, as a range of spans.
template <class Item>
class Groups {
 public:
  struct Iterator {
    const uint32_t* offset;
    const Item* items;

    std::span<const Item> operator*() const { return {items + offset[0], size_t(offset[1] - offset[0])}; }
    Iterator& operator++() {
      ++offset;
      return *this;
    }
    bool operator==(const Iterator& other) const { return offset == other.offset; }
  };

  Groups(const uint32_t* offsets, size_t count, const Item* items) : offsets_(offsets), count_(count), items_(items) {}
  size_t size() const { return count_; }
  std::span<const Item> operator[](size_t i) const { return *Iterator{offsets_ + i, items_}; }
  Iterator begin() const { return {offsets_, items_}; }
  Iterator end() const { return {offsets_ + count_, items_}; }

 private:
  const uint32_t* offsets_;
  size_t count_;
  const Item* items_;
};

/// Groups of items: group g holds items[offsets[g]] .. items[offsets[g + 1] - 1]. `Group` is what they are numbered by: size_t or an Id.
template <class Item, class Group = size_t>
struct Csr {
  std::vector<uint32_t> offsets{0};
  std::vector<Item> items;

  size_t size() const { return offsets.size() - 1; }
  std::span<const Item> operator[](Group group) const {
    const size_t g = indexOf(group);
    return {items.data() + offsets[g], offsets[g + 1] - offsets[g]};
  }
  std::span<Item> operator[](Group group) {
    const size_t g = indexOf(group);
    return {items.data() + offsets[g], offsets[g + 1] - offsets[g]};
  }

  /// Groups first .. past - 1.
  Groups<Item> groups(size_t first, size_t past) const { return {offsets.data() + first, past - first, items.data()}; }

  /// Forgets all groups, but keeps their memory.
  void clear() {
    offsets.assign(1, 0);
    items.clear();
  }
  /// Ends a group: it holds the items that were appended since the one before it.
  void endGroup() { offsets.push_back(uint32_t(items.size())); }
  /// Appends the groups of another one.
  void append(const Csr& more) {
    appendOffsets(offsets, more.offsets);
    items.insert(items.end(), more.items.begin(), more.items.end());
  }
  /// The same with changed(item) for each item.
  template <class F>
  void append(const Csr& more, const F& changed) {
    appendOffsets(offsets, more.offsets);
    for (const Item& item : more.items) items.push_back(changed(item));
  }
};

/// The same in memory of somebody else.
template <class Item, class Group = size_t>
struct CsrSpan {
  std::span<const uint32_t> offsets;
  std::span<const Item> items;

  std::span<const Item> operator[](Group group) const {
    const size_t g = indexOf(group);
    return items.subspan(offsets[g], offsets[g + 1] - offsets[g]);
  }
  /// Groups first .. past - 1.
  Groups<Item> groups(size_t first, size_t past) const { return {offsets.data() + first, past - first, items.data()}; }
};

/// Turns the numbers of items of groups, and a 0 after them, into offsets. Gives their sum.
inline uint32_t toOffsets(std::vector<uint32_t>& counts) {
  uint32_t sum = 0;
  for (uint32_t& count : counts) sum += std::exchange(count, sum);
  return sum;
}
/// Makes them offsets again after groups were filled, which moved each to the end of its group.
inline void moveBack(std::vector<uint32_t>& offsets) {
  std::copy_backward(offsets.begin(), offsets.end() - 1, offsets.end());
  offsets[0] = 0;
}

/// Groups n items by groupOf(i); itemOf(i) is stored. The order within a group is that of i.
template <class Item, class Group = size_t, class GroupOf, class ItemOf>
Csr<Item, Group> groupBy(size_t groups, size_t n, const GroupOf& groupOf, const ItemOf& itemOf) {
  Csr<Item, Group> csr;
  csr.offsets.assign(groups + 1, 0);
  for (size_t i = 0; i < n; ++i) ++csr.offsets[indexOf(groupOf(i))];
  toOffsets(csr.offsets);
  csr.items.resize(n);
  for (size_t i = 0; i < n; ++i) csr.items[csr.offsets[indexOf(groupOf(i))]++] = itemOf(i);
  moveBack(csr.offsets);
  return csr;
}

struct KeyedItem {
  uint64_t key;
  uint32_t item;
};

/// Sorts by key, its lowest bits left out, stably: many items by radix, in as many passes as the largest key needs.
inline void sortByKey(std::vector<KeyedItem>& items, uint64_t largestKey, int lowestBits = 0) {
  constexpr int kBits = 11;
  constexpr size_t kFew = 64;
  if (items.size() < kFew)
    return sortItems(items, [=](const KeyedItem& a, const KeyedItem& b) { return a.key >> lowestBits < b.key >> lowestBits; });
  std::vector<KeyedItem> other(items.size());
  for (int shift = lowestBits; shift < 64 && (largestKey >> shift) != 0; shift += kBits) {
    uint32_t at[(1 << kBits) + 1] = {};
    const auto digit = [shift](const KeyedItem& k) { return (k.key >> shift) & ((1 << kBits) - 1); };
    for (const KeyedItem& k : items) ++at[digit(k) + 1];
    for (int d = 0; d < (1 << kBits); ++d) at[d + 1] += at[d];
    for (const KeyedItem& k : items) other[at[digit(k)]++] = k;
    items.swap(other);
  }
}

}  // namespace mandoline::detail
