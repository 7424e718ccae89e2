// The lowest of many items.
#pragma once

#include <cstddef>
#include <vector>

#include "base/sort.h"

namespace mandoline::detail {

/// Keeps the `most` lowest items, in any order.
template <class Item>
void keepLowest(std::vector<Item>& items, size_t most) {
  if (items.size() <= most) return;
  sortItems(items);
  items.resize(most);
}

}  // namespace mandoline::detail
