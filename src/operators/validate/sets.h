#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mandoline::validation {

/// Disjoint sets of 0..n-1.
class Sets {
 public:
  void reset(size_t n) {
    parent_.resize(n);
    for (size_t i = 0; i < n; ++i) parent_[i] = uint32_t(i);
  }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(uint32_t i, uint32_t j) {
    i = find(i), j = find(j);
    parent_[i < j ? j : i] = i < j ? i : j;
  }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace mandoline::validation
