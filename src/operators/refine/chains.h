// Vertices that lie on edges of larger cells.
#pragma once

#include <algorithm>
#include <span>

#include "base/csr.h"
#include "base/key_numbers.h"

namespace mandoline::refining {

/// Chains one after the other, each with its ends.
using ChainList = detail::Csr<uint32_t>;

class Chains {
 public:
  /// Of several chains between the same two vertices, which are the same, the first counts.
  void add(const ChainList& list) {
    for (size_t i = 0; i < list.size(); ++i) add(list[i]);
  }

  /// Appends a loop with all vertices on its edges.
  template <class Range>
  void append(const Range& loop, std::vector<uint32_t>& to) const {
    for (size_t i = 0; i < loop.size(); ++i) {
      to.push_back(loop[i]);
      appendInside(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0], to);
    }
  }

 private:
  void add(std::span<const uint32_t> chain) {
    const uint32_t from = chain.front(), to = chain.back();
    if (numbers_.add(keyOf(from, to)) != inside_.size()) return;
    inside_.items.insert(inside_.items.end(), chain.begin() + 1, chain.end() - 1);
    inside_.endGroup();
    if (from > to) std::reverse(inside_.items.end() - std::ptrdiff_t(chain.size() - 2), inside_.items.end());
    for (const uint32_t end : {from, to}) {
      if (isEnd_.size() <= end) isEnd_.resize(size_t(end) + 1);
      isEnd_[end] = 1;
    }
  }

  static uint64_t keyOf(uint32_t a, uint32_t b) { return uint64_t(std::min(a, b)) << 32 | std::max(a, b); }
  bool isEnd(uint32_t v) const { return v < isEnd_.size() && isEnd_[v]; }

  void appendInside(uint32_t from, uint32_t end, std::vector<uint32_t>& to) const {
    if (!isEnd(from) || !isEnd(end)) return;
    const auto number = numbers_.find(keyOf(from, end));
    if (!number) return;
    const std::span<const uint32_t> inside = inside_[*number];
    to.insert(to.end(), inside.begin(), inside.end());
    if (from > end) std::reverse(to.end() - std::ptrdiff_t(inside.size()), to.end());
  }

  detail::KeyNumbers numbers_;
  detail::Csr<uint32_t> inside_;  // from the lower id on
  std::vector<uint8_t> isEnd_;    // per vertex
};

}  // namespace mandoline::refining
