// Which item lies at a position: the only place where positions are compared for equality. 0 equals -0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace mandoline::detail {

/// An open table of ids. `at(id)` points to the three coordinates of an item, which must not change while it is in the table.
template <class At>
class PositionTable {
 public:
  static constexpr uint32_t kFree = ~0u;

  PositionTable(size_t mostItems, const At& at) : at_(at) {
    size_t size = 16;
    while (size < 2 * mostItems) size *= 2;
    slots_.assign(size, kFree);
  }

  /// The slot of the item at p: its id, or kFree, which may then be set to the id of an item there.
  uint32_t& find(const double* p) {
    for (size_t slot = hash(p) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
      if (slots_[slot] == kFree) return slots_[slot];
      const double* q = at_(slots_[slot]);
      if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) return slots_[slot];
    }
  }

 private:
  static size_t hash(const double* p) {
    uint64_t bits[3];
    for (int d = 0; d < 3; ++d) {
      const double x = p[d] + 0.0;  // -0 becomes 0
      std::memcpy(&bits[d], &x, sizeof x);
    }
    uint64_t h = bits[0] * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ bits[1]) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32) ^ bits[2]) * 0x94d049bb133111ebu;
    return size_t(h ^ (h >> 31));
  }

  const At at_;
  std::vector<uint32_t> slots_;
};

/// Per item with `takesPart(id)`, the lowest such item at its position; for other items, themselves.
template <class At, class TakesPart>
std::vector<uint32_t> lowestAtPosition(size_t items, const At& at, const TakesPart& takesPart) {
  PositionTable table(items, at);
  std::vector<uint32_t> lowest(items);
  for (uint32_t i = 0; i < items; ++i) {
    lowest[i] = i;
    if (!takesPart(i)) continue;
    uint32_t& slot = table.find(at(i));
    if (slot == table.kFree) slot = i;
    lowest[i] = slot;
  }
  return lowest;
}

}  // namespace mandoline::detail
