// The spatial index.
#include "base/box_tree.h"

#include <cmath>
#include <random>

#include "catch.h"

using namespace mandoline::detail;

namespace {

/// Boxes on a coarse lattice, so that many touch, are flat, or are the same.
std::vector<BoxTree::Item> latticeBoxes(uint32_t count) {
  std::mt19937 random(5);
  std::vector<BoxTree::Item> items;
  for (uint32_t id = 0; id < count; ++id) {
    Box box;
    for (int d = 0; d < 3; ++d) {
      box.low[d] = double(random() % 12);
      box.high[d] = box.low[d] + double(random() % 4);
    }
    items.push_back({box, id});
  }
  return items;
}

std::vector<uint32_t> overlapping(const BoxTree& tree, const Box& box) {
  std::vector<uint32_t> ids;
  tree.forOverlapping(box, [&](uint32_t id) { ids.push_back(id); });
  return ids;
}

}  // namespace

TEST_CASE("box tree: finds what a search through all boxes finds", "[box_tree]") {
  for (const uint32_t count : {0u, 1u, 8u, 9u, 500u}) {
    const std::vector<BoxTree::Item> items = latticeBoxes(count);
    BoxTree tree;
    tree.build(3, [&](size_t) { return BoxTree::Item{{{0, 0, 0}, {20, 20, 20}}, 7777}; });  // forgotten
    tree.build(items.size(), [&](size_t i) { return items[i]; });
    for (const BoxTree::Item& query : latticeBoxes(60)) {
      std::vector<uint32_t> expected, found = overlapping(tree, query.box);
      for (const BoxTree::Item& item : items) {
        if (item.box.overlaps(query.box)) expected.push_back(item.id);
      }
      std::sort(found.begin(), found.end());
      CHECK(found == expected);
    }
  }
}

TEST_CASE("box tree: the order of the results does not depend on the order of the items", "[box_tree]") {
  std::vector<BoxTree::Item> items = latticeBoxes(500);
  BoxTree tree, shuffled;
  tree.build(items.size(), [&](size_t i) { return items[i]; });
  std::shuffle(items.begin(), items.end(), std::mt19937(6));
  shuffled.build(items.size(), [&](size_t i) { return items[i]; });
  for (const BoxTree::Item& query : latticeBoxes(60)) CHECK(overlapping(tree, query.box) == overlapping(shuffled, query.box));
}

TEST_CASE("box tree: from above finds the same, and little where the first that is found ends the search", "[box_tree]") {
  const std::vector<BoxTree::Item> items = latticeBoxes(500);
  BoxTree tree;
  tree.forOverlappingFromAbove({{0, 0, 0}, {1, 1, 1}}, 0, [](uint32_t) { FAIL("the tree is empty"); });
  tree.build(items.size(), [&](size_t i) { return items[i]; });
  for (const BoxTree::Item& query : latticeBoxes(60)) {
    std::vector<uint32_t> expected = overlapping(tree, query.box), found;
    tree.forOverlappingFromAbove(query.box, query.id % 3, [&](uint32_t id) { found.push_back(id); });
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    CHECK(found == expected);
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    constexpr uint32_t kCount = 5000;  // flat boxes over each other
    tree.build(kCount, [&](size_t i) {
      BoxTree::Item item{{{0, 0, 0}, {1, 1, 1}}, uint32_t(i)};
      item.box.low[axis] = item.box.high[axis] = double(i);
      return item;
    });
    for (const uint32_t top : {kCount - 1, 1234u, 7u}) {
      Box box{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
      box.low[axis] = -INFINITY;
      box.high[axis] = top;
      size_t calls = 0;
      uint32_t highest = 0;
      tree.forOverlappingFromAbove(box, axis, [&](uint32_t id) {
        ++calls;
        highest = std::max(highest, id);
        box.low[axis] = highest;
      });
      CHECK(highest == top);
      CHECK(calls <= 8);
    }
  }
}

TEST_CASE("box tree: infinite boxes and those of nothing do no harm", "[box_tree]") {
  std::vector<BoxTree::Item> items = latticeBoxes(100);
  for (size_t i = 0; i < items.size(); i += 3) {
    const double end = i % 2 == 0 ? INFINITY : -INFINITY;
    items[i].box = {{-end, -end, -end}, {end, end, end}};
  }
  BoxTree tree;
  tree.build(items.size(), [&](size_t i) { return items[i]; });
  const std::vector<uint32_t> found = overlapping(tree, {{-5, -5, -5}, {-5, -5, -5}});
  CHECK(found.size() == 17);
  for (const uint32_t id : found) CHECK(id % 6 == 0);
}
