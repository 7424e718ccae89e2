// A spatial index of triangles.
#pragma once

#include <algorithm>
#include <cstddef>

#include "mesh/welded_mesh.h"

namespace mandoline::detail {

struct Box {
  Point low, high;

  bool overlaps(const Box& other) const {
    for (int d = 0; d < 3; ++d) {
      if (low[d] > other.high[d] || high[d] < other.low[d]) return false;
    }
    return true;
  }
  void include(const Box& other) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], other.low[d]);
      high[d] = std::max(high[d], other.high[d]);
    }
  }
};

/// Of a triangle.
inline Box boxOf(const WeldedMesh& mesh, uint32_t t) {
  const auto& v = mesh.triangles[t];
  Box box{mesh.points[v[0]], mesh.points[v[0]]};
  for (int i = 1; i < 3; ++i) box.include({mesh.points[v[i]], mesh.points[v[i]]});
  return box;
}

/// A balanced tree of the triangles' boxes: every node halves its triangles by their centres along the longest side of its box.
class BoxTree {
 public:
  BoxTree(const WeldedMesh& mesh, const std::vector<uint32_t>& triangles) {
    for (const uint32_t t : triangles) items_.push_back({boxOf(mesh, t), t});
    if (!items_.empty()) build(0, items_.size());
  }

  /// Calls f(triangle) for those whose boxes overlap the given one.
  template <class F>
  void forOverlapping(const Box& box, const F& f) const {
    for (size_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      const bool overlaps = node.box.overlaps(box);
      if (overlaps && node.past == n + 1) {
        for (size_t i = node.begin; i < node.end; ++i) {
          if (items_[i].box.overlaps(box)) f(items_[i].triangle);
        }
      }
      n = overlaps ? n + 1 : node.past;
    }
  }

 private:
  static constexpr size_t kLeaf = 8;

  struct Item {
    Box box;
    uint32_t triangle;
  };
  /// In depth-first order, so that past a node comes what is not below it; a leaf has nothing below.
  struct Node {
    Box box;
    size_t begin, end, past;
  };

  void build(size_t begin, size_t end) {
    const size_t n = nodes_.size();
    nodes_.push_back({items_[begin].box, begin, end, 0});
    for (size_t i = begin; i < end; ++i) nodes_[n].box.include(items_[i].box);
    if (end - begin > kLeaf) {
      const size_t middle = begin + (end - begin) / 2;
      int axis = 0;
      const auto length = [&](int d) { return nodes_[n].box.high[d] - nodes_[n].box.low[d]; };
      for (int d = 1; d < 3; ++d) {
        if (length(d) > length(axis)) axis = d;
      }
      const auto centre = [axis](const Item& item) { return item.box.low[axis] + item.box.high[axis]; };
      std::nth_element(items_.begin() + ptrdiff_t(begin), items_.begin() + ptrdiff_t(middle), items_.begin() + ptrdiff_t(end),
                       [&](const Item& a, const Item& b) { return centre(a) < centre(b); });
      build(begin, middle);
      build(middle, end);
    }
    nodes_[n].past = nodes_.size();
  }

  std::vector<Item> items_;
  std::vector<Node> nodes_;
};

}  // namespace mandoline::detail
