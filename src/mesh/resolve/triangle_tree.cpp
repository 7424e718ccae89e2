#include "mesh/resolve/triangle_tree.h"

#include <cmath>

#include "base/csr.h"

namespace mandoline::detail {

namespace {

/// Scaled coordinates are 0 or between 2^-80 and 2^122 (see Scale), so that single precision holds them all, rounded.
LooseBox boxOf(const SortedMesh& mesh, size_t triangle) {
  const auto& v = mesh.triangles[triangle];
  const Point &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
  const auto room = [](float x) { return std::fabs(x) * 0x1p-23f; };  // more than x was rounded by
  LooseBox box;
  for (size_t d = 0; d < 3; ++d) {
    const float low = float(std::min(std::min(a[d], b[d]), c[d])), high = float(std::max(std::max(a[d], b[d]), c[d]));
    box.low[d] = low - room(low);
    box.high[d] = high + room(high);
  }
  return box;
}

}  // namespace

TriangleTree::TriangleTree(const SortedMesh& mesh, const std::vector<uint32_t>& groupOf, size_t groups) {
  const size_t triangles = mesh.triangles.size();
  Csr<Item> byGroup = groupBy<Item>(
      groups, triangles, [&](size_t t) { return groupOf[t]; },
      [&](size_t t) {
        return Item{boxOf(mesh, t), groupOf[t], uint32_t(t)};
      });
  items_ = std::move(byGroup.items);
  starts_ = std::move(byGroup.offsets);
  nodes_.reserve(triangles / 4 + 1);
  if (triangles > 0) addNode(0, uint32_t(triangles));
}

void TriangleTree::addNode(uint32_t begin, uint32_t end) {
  const uint32_t n = uint32_t(nodes_.size());
  const uint32_t group = items_[begin].group == items_[end - 1].group ? items_[begin].group : kMixed;
  nodes_.push_back({items_[begin].box, begin, end, 0, group});
  if (end - begin > kLeaf) {
    const uint32_t middle = middleOf(begin, end), low = n + 1;
    addNode(begin, middle);
    const uint32_t high = uint32_t(nodes_.size());
    addNode(middle, end);
    nodes_[n].box = nodes_[low].box;
    nodes_[n].box.include(nodes_[high].box);
  } else {
    for (uint32_t i = begin + 1; i < end; ++i) nodes_[n].box.include(items_[i].box);
  }
  nodes_[n].past = uint32_t(nodes_.size());
}

/// Halfway, or between two groups if there are several.
uint32_t TriangleTree::middleOf(uint32_t begin, uint32_t end) const {
  const uint32_t middle = begin + (end - begin) / 2, group = items_[middle].group;
  const uint32_t first = starts_[group], past = starts_[group + 1];
  if (first <= begin && past >= end) return middle;
  return first > begin && (past >= end || middle - first <= past - middle) ? first : past;
}

std::vector<TriangleTree::LeafPair> TriangleTree::overlappingLeaves() const {
  std::vector<LeafPair> pairs, open;  // open: pairs of nodes still to be looked into
  if (!nodes_.empty()) open.push_back({0, 0});
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    if (inOneGroup(a, b) || (a != b && !nodes_[a].box.overlaps(nodes_[b].box))) continue;
    if (isLeaf(a) && isLeaf(b)) {
      pairs.push_back({a, b});
    } else if (a == b) {
      open.push_back({a + 1, a + 1});
      open.push_back({a + 1, nodes_[a + 1].past});
      open.push_back({nodes_[a + 1].past, nodes_[a + 1].past});
    } else {
      const bool halveA = !isLeaf(a) && (isLeaf(b) || nodes_[a].end - nodes_[a].begin >= nodes_[b].end - nodes_[b].begin);
      const uint32_t halved = halveA ? a : b, other = halveA ? b : a;
      open.push_back({halved + 1, other});
      open.push_back({nodes_[halved + 1].past, other});
    }
  }
  return pairs;
}

TriangleTree::Reaching TriangleTree::reaching(const Node& leaf, const LooseBox& box) const {
  Reaching found;
  for (uint32_t i = leaf.begin; i < leaf.end; ++i) {
    found.items[found.count] = &items_[i];
    found.count += items_[i].box.overlaps(box);
  }
  return found;
}

}  // namespace mandoline::detail
