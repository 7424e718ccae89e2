// Numbers for keys, in the order in which they come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace mandoline::detail {

class KeyNumbers {
 public:
  KeyNumbers() : slots_(64, kFree) {}

  std::vector<uint64_t> keys;  ///< by their numbers

  /// The number of a key, which gets the next one if it has none yet.
  uint32_t add(uint64_t key) {
    if (!keys.empty() && keys[last_] == key) return last_;
    std::swap(last_, secondLast_);  // two often take turns
    if (!keys.empty() && keys[last_] == key) return last_;
    return addAny(key);
  }
  /// The same, quicker where it can't be foretold which key comes.
  uint32_t addAny(uint64_t key) {
    const size_t slot = slotOf(key);
    if (slots_[slot] != kFree) return last_ = slots_[slot];
    slots_[slot] = last_ = uint32_t(keys.size());
    keys.push_back(key);
    if (2 * keys.size() > slots_.size()) {
      slots_.assign(2 * slots_.size(), kFree);
      for (uint32_t k = 0; k < keys.size(); ++k) slots_[slotOf(keys[k])] = k;
    }
    return last_;
  }
  std::optional<uint32_t> find(uint64_t key) const {
    const uint32_t at = slots_[slotOf(key)];
    if (at == kFree) return {};
    return at;
  }

 private:
  static constexpr uint32_t kFree = ~0u;

  size_t slotOf(uint64_t key) const {
    size_t at = size_t((key * 0x9e3779b97f4a7c15u) >> 32);
    while (slots_[at & (slots_.size() - 1)] != kFree && keys[slots_[at & (slots_.size() - 1)]] != key) ++at;
    return at & (slots_.size() - 1);
  }

  std::vector<uint32_t> slots_;  // a hash table of numbers by key
  uint32_t last_ = 0, secondLast_ = 0;
};

}  // namespace mandoline::detail
