// Sorting is that of std::stable_sort, for few items and for many.
#include "base/sort.h"

#include <algorithm>
#include <array>
#include <random>
#include <span>
#include <vector>

#include "catch.h"

using namespace mandoline::detail;

namespace {

/// Items with equal keys, told apart by where they were.
template <size_t kMore>
struct Item {
  uint32_t key, place;
  std::array<double, kMore> more;
};

template <size_t kMore>
void checkSorting(size_t count, uint32_t keys) {
  std::mt19937 random{uint32_t(count)};
  std::vector<Item<kMore>> items(count);
  for (uint32_t i = 0; i < count; ++i) items[i] = {uint32_t(random() % keys), i, {}};
  const auto isBefore = [](const auto& a, const auto& b) { return a.key < b.key; };
  auto expected = items;
  std::stable_sort(expected.begin(), expected.end(), isBefore);
  sortItems(items, isBefore);
  const auto same = [](const auto& a, const auto& b) { return a.key == b.key && a.place == b.place; };
  CHECK(std::equal(items.begin(), items.end(), expected.begin(), expected.end(), same));
}

}  // namespace

TEST_CASE("Items are sorted stably, however many and however large", "[base]") {
  for (size_t count = 0; count < 100; ++count) checkSorting<1>(count, 7);
  for (const uint32_t keys : {1, 10, 1000000}) {
    checkSorting<1>(5000, keys);
    checkSorting<6>(1037, keys);
  }
}

TEST_CASE("Vectors, arrays and parts of them are sorted by <", "[base]") {
  std::vector<double> numbers;
  for (int i = 0; i < 200; ++i) numbers.push_back((i * 77) % 200);
  sortItems(std::span<double>(numbers.data() + 100, 100));
  CHECK_FALSE(std::is_sorted(numbers.begin(), numbers.begin() + 100));
  CHECK(std::is_sorted(numbers.begin() + 100, numbers.end()));
  sortItems(numbers);
  CHECK(std::is_sorted(numbers.begin(), numbers.end()));
  std::array<int, 3> three{3, 1, 2};
  sortItems(three);
  CHECK(three == std::array<int, 3>{1, 2, 3});
}
