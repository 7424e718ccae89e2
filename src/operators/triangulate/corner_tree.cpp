#include "operators/triangulate/corner_tree.h"

#include <algorithm>

namespace mandoline::operators {

void CornerTree::build(const std::vector<Corner>& corners) {
  order_.clear();
  for (uint32_t i = 0; i < corners.size(); ++i) order_.push_back(i);
  const Range all = {0, uint32_t(order_.size()), 0};
  split(corners, all);
  slot_.resize(order_.size());
  living_.resize(order_.size());
  for (uint32_t s = 0; s < order_.size(); ++s) slot_[order_[s]] = s;
  countLiving(all);
}

void CornerTree::remove(uint32_t corner) {
  uint32_t begin = 0, end = uint32_t(order_.size());
  for (;;) {
    const uint32_t middle = begin + (end - begin) / 2;
    --living_[middle];
    if (middle == slot_[corner]) return;
    (slot_[corner] < middle ? end : begin) = slot_[corner] < middle ? middle : middle + 1;
  }
}

void CornerTree::split(const std::vector<Corner>& corners, const Range& range) {
  if (range.end - range.begin < 2) return;
  const auto at = [&](uint32_t slot) { return order_.begin() + slot; };
  std::nth_element(at(range.begin), at(range.middle()), at(range.end), [&](uint32_t a, uint32_t b) {
    const double x = coordinate(corners[a].at, range.axis), y = coordinate(corners[b].at, range.axis);
    return x != y ? x < y : a < b;
  });
  split(corners, range.lower());
  split(corners, range.upper());
}

uint32_t CornerTree::countLiving(const Range& range) {
  if (range.begin == range.end) return 0;
  return living_[range.middle()] = 1 + countLiving(range.lower()) + countLiving(range.upper());
}

}  // namespace mandoline::operators
