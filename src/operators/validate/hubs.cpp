#include "operators/validate/hubs.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::validation {
namespace {

constexpr size_t kMany = 32;

size_t endAt(const std::vector<Hubs::At>& items, size_t begin) {
  size_t end = begin;
  while (end < items.size() && items[end].vertex == items[begin].vertex) ++end;
  return end;
}

}  // namespace

void Hubs::find(const GridCell& cell, const std::vector<Edge>& edges) {
  hubs_.clear(), faces_.clear(), edges_.clear();
  for (uint32_t f = 0; f < cell.faces.size(); ++f) {
    if (cell.context.cut.faceTriangle[cell.faces[f].id] < 0) continue;
    for (const uint32_t v : cell.vertices(f)) faces_.push_back({v, f});
  }
  if (faces_.size() < 3 * kMany) return;
  detail::sortUnique(faces_);
  for (size_t begin = 0, end = 0; begin < faces_.size(); begin = end) {
    end = endAt(faces_, begin);
    if (end - begin >= kMany) hubs_.push_back({faces_[begin].vertex, {faces_.data() + begin, end - begin}, {}});
  }
  for (uint32_t e = 0; e < edges.size(); ++e) {
    for (const uint32_t v : edges[e]) {
      if (at(v)) edges_.push_back({v, e});
    }
  }
  detail::sortUnique(edges_);
  size_t begin = 0;
  for (Hub& hub : hubs_) {  // each has edges
    const size_t end = endAt(edges_, begin);
    hub.edges = {edges_.data() + begin, end - begin};
    begin = end;
  }
}

const Hubs::Hub* Hubs::at(uint32_t vertex) const {
  const auto hub = std::lower_bound(hubs_.begin(), hubs_.end(), vertex, [](const Hub& h, uint32_t v) { return h.vertex < v; });
  return hub != hubs_.end() && hub->vertex == vertex ? &*hub : nullptr;
}

void HubTree::build(const Hubs& hubs, VerticesOf verticesOf) {
  if (!hubs.all().empty()) {
    for (auto& [best, item] : placed_) {
      for (const uint32_t v : verticesOf(item.id)) {
        const Hubs::Hub* hub = hubs.at(v);
        if (hub && (!best || hub->faces.size() > best->faces.size())) best = hub;
      }
    }
    detail::sortItems(placed_, [](const Placed& a, const Placed& b) { return a.hub < b.hub; });
  }
  used_ = 0;
  for (size_t begin = 0, end = 0; begin < placed_.size(); begin = end) {
    while (end < placed_.size() && placed_[end].hub == placed_[begin].hub) ++end;
    if (trees_.size() == used_) trees_.push_back({});
    Tree& tree = trees_[used_++];
    tree.common.clear();
    for (size_t i = begin; i < end && placed_[i].hub; ++i) {
      const auto vertices = verticesOf(placed_[i].item.id);
      const auto isNone = [&](uint32_t v) { return !hubs.at(v) || std::find(vertices.begin(), vertices.end(), v) == vertices.end(); };
      if (i == begin) tree.common.assign(vertices.begin(), vertices.end());
      std::erase_if(tree.common, isNone);
    }
    tree.boxes.build(end - begin, [&](size_t i) { return placed_[begin + i].item; });
  }
}

void HubTree::forOverlapping(const detail::Box& box, std::span<const uint32_t> vertices, detail::FunctionRef<void(uint32_t)> f) const {
  for (size_t i = 0; i < used_; ++i) {
    const std::vector<uint32_t>& common = trees_[i].common;
    if (std::find_first_of(common.begin(), common.end(), vertices.begin(), vertices.end()) != common.end()) continue;
    trees_[i].boxes.forOverlapping(box, f);
  }
}

detail::Box directionsOf(const Vec3& from, std::span<const Vec3> points, const Vec3& margin) {
  Vec3 low{{INFINITY, INFINITY, INFINITY}}, high = -1 * low;
  double least = INFINITY, nearest = 0;
  for (const Vec3& point : points) {
    const Vec3 to = point - from;
    const double size = std::fabs(to[dominantAxis(to)]);
    if (size == 0) continue;
    least = std::min(least, size);
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], to[d] / size), high[d] = std::max(high[d], to[d] / size);
  }
  // Directions between them are less than 1 long before they are divided. An axis along which all lie on one side bounds how much less.
  for (int d = 0; d < 3; ++d) nearest = std::max({nearest, low[d], -high[d]});
  if (nearest == 0 || least == INFINITY) return boxOf({{-INFINITY, -INFINITY, -INFINITY}}, {{INFINITY, INFINITY, INFINITY}});
  for (int d = 0; d < 3; ++d) {
    const double doubt = 4 * margin[d] / least;
    low[d] = std::min(low[d], low[d] / nearest) - doubt, high[d] = std::max(high[d], high[d] / nearest) + doubt;
  }
  return boxOf(low, high);
}

}  // namespace mandoline::validation
