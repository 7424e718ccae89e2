// Numbers for a few keys, again and again for others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mandoline::detail {

/// A hash table that is emptied by counting up a stamp.
class StampedTable {
 public:
  struct Slot {
    uint64_t key;
    uint32_t stamp, number;
  };
  /// The table until it is emptied. By value: what it consists of stays in registers.
  class View {
   public:
    View(Slot* slots, size_t mask, uint32_t stamp) : slots_(slots), mask_(mask), stamp_(stamp) {}

    bool isFree(const Slot& slot) const { return slot.stamp != stamp_; }
    /// The slot of a key, which is free if the key is not there.
    Slot& at(uint64_t key) const {
      size_t place = size_t((key * 0x9e3779b97f4a7c15u) >> 40);
      while (!isFree(slots_[place & mask_]) && slots_[place & mask_].key != key) ++place;
      return slots_[place & mask_];
    }
    /// Puts a key into its slot, which is free.
    void put(Slot& slot, uint64_t key, uint32_t number) const { slot = {key, stamp_, number}; }

   private:
    Slot* const slots_;
    const size_t mask_;
    const uint32_t stamp_;
  };

  /// Empties it, to be called before view(). From then on it uses at least so many slots; keys should leave a quarter of them free.
  View clear(size_t slots) {
    mask_ = 63;
    while (mask_ < slots) mask_ = 2 * mask_ + 1;
    if (slots_.size() <= mask_ || ++stamp_ == 0) {
      slots_.assign(mask_ + 1, {0, 0, 0});
      stamp_ = 1;
    }
    return view();
  }
  View view() { return {slots_.data(), mask_, stamp_}; }

 private:
  std::vector<Slot> slots_;
  uint32_t stamp_ = 0;
  size_t mask_ = 0;
};

}  // namespace mandoline::detail
