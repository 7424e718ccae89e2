// A set of numbers of which many are near each other, as places in a grid are.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/key_numbers.h"
#include "base/sort.h"

namespace mandoline::detail {

/// A hash table of words, each with a bit for 64 numbers next to each other.
class RankedSet {
 public:
  static constexpr uint32_t kNone = ~0u;

  void insert(uint64_t number) {
    const uint32_t w = keys_.add(number / 64);
    if (w == words_.size()) words_.emplace_back();
    words_[w].bits |= bitOf(number);
  }

  /// To be called after the last insertion.
  void rank() {
    ascending_.clear();
    for (uint32_t w = 0; w < words_.size(); ++w) ascending_.push_back(w);
    sortItems(ascending_, [this](uint32_t a, uint32_t b) { return keys_.keys[a] < keys_.keys[b]; });
    size_ = 0;
    for (const uint32_t w : ascending_) {
      words_[w].first = uint32_t(size_);
      size_ += size_t(std::popcount(words_[w].bits));
    }
  }
  size_t size() const { return size_; }

  /// How many lower numbers the set has, or kNone of a number that it does not have.
  uint32_t rankOf(uint64_t number) const {
    const auto w = keys_.find(number / 64);
    if (!w || !(words_[*w].bits & bitOf(number))) return kNone;
    return words_[*w].first + uint32_t(std::popcount(words_[*w].bits & (bitOf(number) - 1)));
  }
  /// Calls f(number) for all, ascending.
  template <class F>
  void forEach(const F& f) const {
    for (const uint32_t w : ascending_) {
      for (uint64_t bits = words_[w].bits; bits != 0; bits &= bits - 1) f(64 * keys_.keys[w] + uint64_t(std::countr_zero(bits)));
    }
  }

 private:
  struct Word {
    uint64_t bits = 0;
    uint32_t first = 0;  // how many lower numbers there are than those of the word
  };

  static uint64_t bitOf(uint64_t number) { return uint64_t(1) << number % 64; }

  KeyNumbers keys_;
  std::vector<Word> words_;          // by the numbers of their keys
  std::vector<uint32_t> ascending_;  // of the words
  size_t size_ = 0;
};

}  // namespace mandoline::detail
