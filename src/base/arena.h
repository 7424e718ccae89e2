// Memory for arrays that are made one after the other and given back together: their pages are got in large blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

#include "base/large_array.h"

namespace mandoline::detail {

class Arena {
 public:
  /// A copy, which stays where it is for as long as the arena.
  template <class Item>
  std::span<const Item> copy(std::span<const Item> items) {
    static_assert(std::is_trivially_copyable_v<Item> && alignof(Item) <= kAlignment);
    if (items.empty()) return {};
    void* to = take(items.size_bytes());
    std::memcpy(to, items.data(), items.size_bytes());
    return {static_cast<const Item*>(to), items.size()};
  }
  template <class Item>
  std::span<const Item> copy(const std::vector<Item>& items) {
    return copy(std::span<const Item>(items));
  }
  /// As many items as `count`, which f(items) writes.
  template <class Item, class F>
  std::span<const Item> make(size_t count, const F& f) {
    static_assert(std::is_trivially_copyable_v<Item> && alignof(Item) <= kAlignment);
    if (count == 0) return {};
    const std::span<Item> items(static_cast<Item*>(take(count * sizeof(Item))), count);
    f(items);
    return items;
  }
  /// Puts f(item) in the place of each item of such a copy.
  template <class Item, class F>
  static void rewrite(std::span<const Item> copy, const F& f) {
    for (Item& item : std::span(const_cast<Item*>(copy.data()), copy.size())) item = f(item);
  }
  /// Forgets all that was copied. What is copied next goes into the last of its memory, which is the largest in general.
  void clear() {
    if (blocks_.empty()) return;
    blocks_.erase(blocks_.begin(), blocks_.end() - 1);
    next_ = static_cast<std::byte*>(blocks_.back().get());
    left_ = size_;
    bytes_ = 0;
  }
  /// All that were copied.
  size_t bytes() const { return bytes_; }

 private:
  static constexpr size_t kAlignment = 16, kFirst = size_t(1) << 16, kLargePages = size_t(1) << 21, kLargest = size_t(1) << 22,
                          kSecond = kHasLargePages ? 2 * kFirst : kLargePages;

  struct Free {
    size_t bytes;
    void operator()(void* block) const {
      if (bytes < kLargePages) {
        ::operator delete (block, std::align_val_t{kAlignment});
      } else {
        giveBackLargePages(block, bytes);
      }
    }
  };

  void* take(size_t bytes) {
    bytes = (bytes + kAlignment - 1) & ~(kAlignment - 1);
    if (bytes > left_) addBlock(bytes);
    std::byte* const taken = next_;
    next_ += bytes;
    left_ -= bytes;
    bytes_ += bytes;
    return taken;
  }

  /// Small at first, since most cuts are, and as long as they fill no large page, of which the system clears all.
  void addBlock(size_t least) {
    size_ = std::max(size_ == 0 ? kFirst : std::clamp(2 * size_, kSecond, kLargest), least);
    if (size_ >= kLargePages) size_ = inWholePages(size_);
    std::unique_ptr<void, Free> block(size_ < kLargePages ? ::operator new (size_, std::align_val_t{kAlignment}) : takeLargePages(size_),
                                      Free{size_});
    blocks_.push_back(std::move(block));
    next_ = static_cast<std::byte*>(blocks_.back().get());
    left_ = size_;
  }

  std::vector<std::unique_ptr<void, Free>> blocks_;
  std::byte* next_ = nullptr;
  size_t left_ = 0, size_ = 0, bytes_ = 0;
};

}  // namespace mandoline::detail
