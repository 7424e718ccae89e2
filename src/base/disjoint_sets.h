// Disjoint sets with path halving; the lowest member is the root, so roots do not depend on the order of unions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/id.h"

namespace mandoline::detail {

class DisjointSets {
 public:
  explicit DisjointSets(size_t n = 0) { reset(n); }
  void reset(size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  size_t size() const { return parent_.size(); }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(uint32_t i, uint32_t j) {
    i = find(i);
    j = find(j);
    if (i > j) std::swap(i, j);
    parent_[j] = i;
  }

 private:
  std::vector<uint32_t> parent_;
};

/// The same for things of one kind.
template <class Id>
class IdSets {
 public:
  void reset(size_t n) { sets_.reset(n); }
  Id find(Id i) { return {sets_.find(i.number)}; }
  void unite(Id i, Id j) { sets_.unite(i.number, j.number); }

 private:
  DisjointSets sets_;
};

}  // namespace mandoline::detail
