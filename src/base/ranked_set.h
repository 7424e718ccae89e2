// A set of numbers of which many are near each other, as places in a grid are.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/key_numbers.h"
#include "base/sort.h"

namespace mandoline::detail {

/// Words, each with a bit for 64 numbers next to each other: in a hash table, or one for all numbers where those are not too many.
class RankedSet {
 public:
  static constexpr uint32_t kNone = ~0u;

  RankedSet() = default;
  /// For numbers below `limit`. There is no hash table if it takes at most `most` words to do without.
  RankedSet(uint64_t limit, size_t most) : isHashed_(limit / 64 >= most) {
    if (!isHashed_) words_.resize(size_t(limit / 64) + 1);
  }

  void insert(uint64_t number) { words_[isHashed_ ? addKey(number / 64) : number / 64].bits |= bitOf(number); }

  /// To be called after the last insertion.
  void rank() {
    ascending_.clear();
    for (uint32_t w = 0; isHashed_ && w < words_.size(); ++w) ascending_.push_back(w);
    sortItems(ascending_, [this](uint32_t a, uint32_t b) { return keys_.keys[a] < keys_.keys[b]; });
    size_ = 0;
    for (size_t i = 0; i < words_.size(); ++i) {
      Word& word = words_[isHashed_ ? ascending_[i] : i];
      word.first = uint32_t(size_);
      size_ += size_t(std::popcount(word.bits));
    }
  }
  size_t size() const { return size_; }

  /// How many lower numbers the set has, or kNone of a number that it does not have.
  uint32_t rankOf(uint64_t number) const {
    size_t at = size_t(number / 64);
    if (isHashed_) {
      const auto w = keys_.find(number / 64);
      if (!w) return kNone;
      at = *w;
    }
    if (at >= words_.size()) return kNone;
    const Word& word = words_[at];
    if (!(word.bits & bitOf(number))) return kNone;
    return word.first + uint32_t(std::popcount(word.bits & (bitOf(number) - 1)));
  }
  /// Calls f(number) for all, ascending.
  template <class F>
  void forEach(const F& f) const {
    for (size_t i = 0; i < words_.size(); ++i) {
      const size_t w = isHashed_ ? ascending_[i] : i;
      const uint64_t key = isHashed_ ? keys_.keys[w] : i;
      for (uint64_t bits = words_[w].bits; bits != 0; bits &= bits - 1) f(64 * key + uint64_t(std::countr_zero(bits)));
    }
  }

 private:
  struct Word {
    uint64_t bits = 0;
    uint32_t first = 0;  // how many lower numbers there are than those of the word
  };

  static uint64_t bitOf(uint64_t number) { return uint64_t(1) << number % 64; }

  uint32_t addKey(uint64_t key) {
    const uint32_t w = keys_.add(key);
    if (w == words_.size()) words_.emplace_back();
    return w;
  }

  bool isHashed_ = true;
  KeyNumbers keys_;
  std::vector<Word> words_;          // by the numbers of their keys, or by their keys
  std::vector<uint32_t> ascending_;  // of the words in a hash table
  size_t size_ = 0;
};

}  // namespace mandoline::detail
