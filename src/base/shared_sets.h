// Disjoint sets that several threads unite at once. The lowest item of a set stands for it, so in the end nothing depends on their order.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace mandoline::detail {

class SharedSets {
 public:
  explicit SharedSets(size_t n = 0) : parent_(n) {
    for (size_t i = 0; i < n; ++i) parent_[i].store(uint32_t(i), kRelaxed);
  }
  /// The lowest item of the set, once no thread unites any more.
  uint32_t find(uint32_t i) {
    for (uint32_t up; (up = parent_[i].load(kRelaxed)) != i; i = up) {
      const uint32_t next = parent_[up].load(kRelaxed);
      if (next != up) parent_[i].store(next, kRelaxed);  // who is above stays so
    }
    return i;
  }
  void unite(uint32_t i, uint32_t j) {
    for (;;) {
      i = find(i), j = find(j);
      if (i == j) return;
      if (i > j) std::swap(i, j);
      uint32_t top = j;
      if (parent_[j].compare_exchange_strong(top, i, kRelaxed)) return;  // or j is no longer the lowest of its set
    }
  }

 private:
  static constexpr std::memory_order kRelaxed = std::memory_order_relaxed;
  std::vector<std::atomic<uint32_t>> parent_;
};

}  // namespace mandoline::detail
