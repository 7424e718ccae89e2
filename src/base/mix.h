// Numbers that stand for many others.
#pragma once

#include <cstdint>

namespace mandoline::detail {

/// A sum of words so far and one more. Each step can be undone, so that another word, or another sum, gives another result.
inline uint64_t mixed(uint64_t sum, uint64_t word) {
  sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
  return sum ^ sum >> 32;
}

}  // namespace mandoline::detail
