// A spatial index.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/function_ref.h"
#include "base/point.h"
#include "base/shared.h"

namespace mandoline::detail {

template <class Number>
struct BoxOf {
  std::array<Number, 3> low, high;

  static BoxOf empty() {
    constexpr Number kFar = std::numeric_limits<Number>::infinity();
    return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  }
  bool overlaps(const BoxOf& other) const {
    int within = 1;  // without branches, which are hard to predict here
    for (size_t d = 0; d < 3; ++d) within &= int(low[d] <= other.high[d]) & int(other.low[d] <= high[d]);
    return within != 0;
  }
  void include(const BoxOf& other) {
    for (size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], other.low[d]);
      high[d] = std::max(high[d], other.high[d]);
    }
  }
};
using Box = BoxOf<double>;

/// A balanced tree of boxes, whose nodes halve their items in the order of a space-filling curve through the centres.
class BoxTree {
 public:
  struct Item {
    Box box;
    uint32_t id;
  };

  /// Holds itemOf(0) .. itemOf(count - 1) from now on, instead of what it held.
  MANDOLINE_SHARED void build(size_t count, FunctionRef<Item(size_t)> itemOf);

  /// Calls f(id) for the items whose boxes overlap the given one, in an order that the items alone decide.
  MANDOLINE_SHARED void forOverlapping(const Box& box, FunctionRef<void(uint32_t)> f) const;
  /// The same, mostly starting with items that reach farther along the axis; f may lower the box meanwhile.
  void forOverlappingFromAbove(const Box& box, size_t axis, FunctionRef<void(uint32_t)> f) const {
    if (!nodes_.empty()) visitFromAbove(0, box, axis, f);
  }

 private:
  static constexpr uint32_t kLeaf = 8;

  /// In depth-first order, so that past a node comes what is not below it; a leaf has nothing below.
  struct Node {
    Box box;
    uint32_t begin, end, past;
  };

  void visitLeaf(const Node& node, const Box& box, FunctionRef<void(uint32_t)> f) const;
  void visitFromAbove(uint32_t n, const Box& box, size_t axis, FunctionRef<void(uint32_t)> f) const;
  void addNode(uint32_t begin, uint32_t end);

  std::vector<Item> items_;
  std::vector<Node> nodes_;
};

}  // namespace mandoline::detail
