// A set of numbers of which many are near each other, as places in a grid are.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/sort.h"

namespace mandoline::detail {

/// A hash table of words, each with a bit for 64 numbers next to each other.
class RankedSet {
 public:
  static constexpr uint32_t kNone = ~0u;

  void insert(uint64_t number) { slotOf(number / 64).bits |= uint64_t(1) << number % 64; }
  void insert(const RankedSet& other) {
    for (const Slot& slot : other.slots_) {
      if (slot.word != kFree) slotOf(slot.word).bits |= slot.bits;
    }
  }

  /// To be called after the last insertion.
  void rank() {
    ascending_.clear();
    for (uint32_t s = 0; s < slots_.size(); ++s) {
      if (slots_[s].word != kFree) ascending_.push_back(s);
    }
    sortItems(ascending_, [this](uint32_t a, uint32_t b) { return slots_[a].word < slots_[b].word; });
    size_ = 0;
    for (const uint32_t s : ascending_) {
      slots_[s].first = uint32_t(size_);
      size_ += size_t(std::popcount(slots_[s].bits));
    }
  }
  size_t size() const { return size_; }

  /// How many lower numbers the set has, or kNone of a number that it does not have.
  uint32_t rankOf(uint64_t number) const {
    if (slots_.empty()) return kNone;
    const Slot& slot = slots_[place(number / 64)];
    const uint64_t bit = uint64_t(1) << number % 64;
    return slot.bits & bit ? slot.first + uint32_t(std::popcount(slot.bits & (bit - 1))) : kNone;
  }
  /// Calls f(number) for all, ascending.
  template <class F>
  void forEach(const F& f) const {
    for (const uint32_t s : ascending_) {
      for (uint64_t bits = slots_[s].bits; bits != 0; bits &= bits - 1) f(64 * slots_[s].word + uint64_t(std::countr_zero(bits)));
    }
  }

 private:
  static constexpr uint64_t kFree = ~uint64_t(0);

  struct Slot {
    uint64_t word = kFree, bits = 0;
    uint32_t first = 0;  // how many lower numbers there are than those of the word
  };

  /// That of the word, or the free one where it would be.
  size_t place(uint64_t word) const {
    const uint64_t hash = word * 0x9e3779b97f4a7c15u;
    for (size_t at = size_t(hash >> 32 ^ hash);; ++at) {
      const Slot& slot = slots_[at & (slots_.size() - 1)];
      if (slot.word == word || slot.word == kFree) return at & (slots_.size() - 1);
    }
  }

  Slot& slotOf(uint64_t word) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[place(word)];
    if (slot.word == kFree) {
      slot.word = word;
      ++used_;
    }
    return slot;
  }

  void grow() {
    std::vector<Slot> former(slots_.empty() ? 64 : 2 * slots_.size());
    former.swap(slots_);
    for (const Slot& slot : former) {
      if (slot.word != kFree) slots_[place(slot.word)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::vector<uint32_t> ascending_;  // of the slots, those that are not free
  size_t used_ = 0, size_ = 0;
};

}  // namespace mandoline::detail
