// Items appended to an array that is made long enough before, so that appending is one store.
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

namespace mandoline::detail {

inline constexpr size_t kAppendedBlock = 4;  ///< of items

/// Overwrites a vector, which gets its length when the appender is destroyed.
template <class Item>
class Appender {
 public:
  /// `most`: how many items may come.
  Appender(std::vector<Item>& items, size_t most) : items_(items) {
    if (items.size() < most) items.resize(most);
    begin_ = end_ = items.data();
  }
  Appender(const Appender&) = delete;
  ~Appender() { items_.resize(size()); }

  size_t size() const { return size_t(end_ - begin_); }
  void add(const Item& item) { *end_++ = item; }
  void fill(size_t count, const Item& item) {
    for (Item* const past = end_ + count; end_ != past; ++end_) *end_ = item;
  }
  template <class Iterator>
  void add(Iterator from, Iterator past) {
    Item* end = end_;
    for (; from != past; ++from) *end++ = *from;
    end_ = end;
  }
  /// Items in memory, block by block, since how many they are can't be foretold: a block more may be read, and needs room.
  void addBlocks(const Item* from, size_t count) {
    for (size_t i = 0; i < count; i += kAppendedBlock) std::memcpy(end_ + i, from + i, kAppendedBlock * sizeof(Item));
    end_ += count;
  }

 private:
  std::vector<Item>& items_;
  Item *begin_, *end_;
};

}  // namespace mandoline::detail
