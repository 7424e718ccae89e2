// Room for large arrays. Where the system offers large pages, their memory comes in these: touched for the first time in pages of 4 KB, it
// takes longer than what is then written into it.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace mandoline::detail {

/// Asks the system for large pages in a part of memory that has not been touched yet. What can't be had is left as it is.
void askForLargePages(void* begin, size_t bytes);

/// Makes an empty array that long.
template <class Item>
void makeLarge(std::vector<Item>& items, size_t count, std::type_identity_t<Item> fill = {}) {
  items.reserve(count);
  askForLargePages(items.data(), count * sizeof(Item));
  items.resize(count, fill);
}

}  // namespace mandoline::detail
