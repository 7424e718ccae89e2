#include "base/box_tree.h"

#include <span>

#include "base/curve_order.h"

namespace mandoline::detail {

void BoxTree::build(size_t count, FunctionRef<Item(size_t)> itemOf) {
  items_.resize(count);
  nodes_.clear();
  if (count == 0) return;
  std::vector<Item> items(count);
  std::vector<Point> centres(count);
  for (size_t i = 0; i < count; ++i) {
    items[i] = itemOf(i);
    for (size_t d = 0; d < 3; ++d) centres[i][d] = items[i].box.low[d] / 2 + items[i].box.high[d] / 2;
  }
  const auto order = orderAlongCurve(centres, [&](size_t i) { return items[i].id; });
  for (size_t i = 0; i < count; ++i) items_[i] = items[order[i].item];
  nodes_.reserve(count / 2 + 1);
  addNode(0, uint32_t(count));
}

void BoxTree::addNode(uint32_t begin, uint32_t end) {
  const auto first = items_.begin() + begin, last = items_.begin() + end;
  const size_t n = nodes_.size();
  nodes_.push_back({first->box, begin, end, 0});
  if (end - begin > kLeaf) {
    const uint32_t middle = begin + (end - begin) / 2, low = uint32_t(nodes_.size());
    addNode(begin, middle);
    const uint32_t high = uint32_t(nodes_.size());
    addNode(middle, end);
    nodes_[n].box = nodes_[low].box;
    nodes_[n].box.include(nodes_[high].box);
  } else {
    sortItems(std::span<Item>(items_.data() + begin, end - begin), [](const Item& a, const Item& b) { return a.id < b.id; });
    for (auto item = first; item != last; ++item) nodes_[n].box.include(item->box);
  }
  nodes_[n].past = uint32_t(nodes_.size());
}

void BoxTree::visitLeaf(const Node& node, const Box& box, FunctionRef<void(uint32_t)> f) const {
  for (uint32_t i = node.begin; i < node.end; ++i) {
    if (items_[i].box.overlaps(box)) f(items_[i].id);
  }
}

void BoxTree::forOverlapping(const Box& box, FunctionRef<void(uint32_t)> f) const {
  for (size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const bool overlaps = node.box.overlaps(box);
    if (overlaps && node.past == n + 1) visitLeaf(node, box, f);
    n = overlaps ? n + 1 : node.past;
  }
}

void BoxTree::visitFromAbove(uint32_t n, const Box& box, size_t axis, FunctionRef<void(uint32_t)> f) const {
  const Node& node = nodes_[n];
  if (!node.box.overlaps(box)) return;
  if (node.past == n + 1) return visitLeaf(node, box, f);
  const uint32_t low = n + 1, high = nodes_[low].past;
  const bool lowFirst = nodes_[low].box.high[axis] > nodes_[high].box.high[axis];
  visitFromAbove(lowFirst ? low : high, box, axis, f);
  visitFromAbove(lowFirst ? high : low, box, axis, f);
}

}  // namespace mandoline::detail
