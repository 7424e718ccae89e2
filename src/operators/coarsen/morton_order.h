// The order of octree cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mandoline::operators {

/// Order along the Morton curve. Decided by the axis whose numbers differ in the highest bit; of several, the last.
inline bool isBefore(const std::array<int32_t, 3>& a, const std::array<int32_t, 3>& b) {
  size_t axis = 2;
  uint32_t most = uint32_t(a[2] ^ b[2]);
  for (const size_t d : {size_t(1), size_t(0)}) {
    const uint32_t differing = uint32_t(a[d] ^ b[d]);
    if (most < differing && most < (most ^ differing)) axis = d, most = differing;
  }
  return a[axis] < b[axis];
}

}  // namespace mandoline::operators
