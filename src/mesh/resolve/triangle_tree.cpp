#include "mesh/resolve/triangle_tree.h"

#include <cmath>

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

TriangleTree::TriangleTree(const SortedMesh& mesh, const std::vector<uint32_t>& groupOf, const Csr<uint32_t>& byGroup, Monitor& monitor)
    : starts_(byGroup.offsets) {
  constexpr size_t kBlock = 1 << 13;  // triangles that are worth a thread
  const size_t triangles = mesh.triangles.size();
  items_.resize(triangles);
  runChunks(
      triangles, chunkCount(triangles, monitor, kBlock), monitor,
      [&](size_t, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
          const uint32_t t = byGroup.items[i];
          items_[i] = {boxOf(mesh, t), groupOf[t], t};
        }
      },
      kBlock);
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

std::vector<TriangleTree::LeafPair> TriangleTree::overlappingLeaves(Monitor& monitor) const {
  constexpr size_t kSeveral = 32;  // for each thread: pairs differ much in what they hold
  std::vector<LeafPair> pairs, open, next;
  if (!nodes_.empty()) (isLeaf(0) ? pairs : open).push_back({0, 0});
  while (!open.empty() && open.size() < kSeveral * monitor.threads()) {
    next.clear();
    for (const LeafPair& nodes : open) divide(nodes, pairs, next);
    open.swap(next);
  }
  const auto chunks = forChunks<std::vector<LeafPair>>(
      open.size(), monitor,
      [&](std::vector<LeafPair>& found, size_t begin, size_t end) {
        std::vector<LeafPair> rest(open.begin() + ptrdiff_t(begin), open.begin() + ptrdiff_t(end));
        while (!rest.empty()) {
          const LeafPair nodes = rest.back();
          rest.pop_back();
          divide(nodes, found, rest);
        }
      },
      kSeveral);
  for (const std::vector<LeafPair>& found : chunks) pairs.insert(pairs.end(), found.begin(), found.end());
  return pairs;
}

/// Halves the larger node of a pair, or both if it is one twice. Adds the pairs that come of it, if they may be of interest.
void TriangleTree::divide(const LeafPair& nodes, std::vector<LeafPair>& leaves, std::vector<LeafPair>& open) const {
  const auto add = [&](uint32_t s, uint32_t t) {
    if (inOneGroup(s, t) || (s != t && !nodes_[s].box.overlaps(nodes_[t].box))) return;
    (isLeaf(s) && isLeaf(t) ? leaves : open).push_back({s, t});
  };
  const auto [a, b] = nodes;
  const bool halveA = !isLeaf(a) && (isLeaf(b) || nodes_[a].end - nodes_[a].begin >= nodes_[b].end - nodes_[b].begin);
  const uint32_t low = (halveA ? a : b) + 1, high = nodes_[low].past, other = a == b ? high : halveA ? b : a;
  if (a == b) add(low, low);
  add(low, other);
  add(high, other);
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
