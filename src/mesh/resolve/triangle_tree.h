// Pairs of triangles whose boxes overlap.
#pragma once

#include "base/box_tree.h"
#include "base/csr.h"
#include "base/large_array.h"
#include "base/parallel.h"
#include "mesh/resolve/sorted_mesh.h"

namespace mandoline::detail {

/// A box in single precision, rounded outwards: half the memory.
using LooseBox = BoxOf<float>;

inline Box boxOf(const WeldedMesh& mesh, uint32_t triangle) {
  const auto& v = mesh.triangles[triangle];
  Box box{mesh.points[v[0]], mesh.points[v[0]]};
  for (size_t i = 1; i < 3; ++i) box.include({mesh.points[v[i]], mesh.points[v[i]]});
  return box;
}

/// A tree of boxes around the triangles of a sorted mesh. Its upper nodes separate groups, its lower ones halve a group in the mesh's
/// order. Pairs within a group are of no interest.
class TriangleTree {
 public:
  /// `groupOf` each triangle, `byGroup` the triangles of each, ascending.
  TriangleTree(const SortedMesh& mesh, const std::vector<uint32_t>& groupOf, const Csr<uint32_t>& byGroup, Monitor& monitor);

  /// Pairs of leaves, or a leaf twice, that hold all pairs of triangles in different groups whose boxes overlap.
  using LeafPair = std::array<uint32_t, 2>;
  std::vector<LeafPair> overlappingLeaves(Monitor& monitor) const;

  /// Calls f(i, j) for the pairs of triangles in two leaves that are in different groups and whose boxes overlap, or would if they were a
  /// rounding larger.
  template <class F>
  void forOverlapping(const LeafPair& leaves, const F& f) const;

 private:
  static constexpr uint32_t kLeaf = 16, kMixed = ~0u;

  struct Item {
    LooseBox box;
    uint32_t group, triangle;
  };
  /// In depth-first order, so that past a node comes what is not below it; a leaf has nothing below.
  struct Node {
    LooseBox box;
    uint32_t begin, end, past;  ///< begin, end: into items_
    uint32_t group;             ///< of all its triangles, or kMixed
  };
  /// Triangles of a leaf that reach into a box.
  struct Reaching {
    uint32_t count = 0;
    const Item* items[kLeaf];
  };

  void addNode(uint32_t begin, uint32_t end);
  uint32_t middleOf(uint32_t begin, uint32_t end) const;
  bool isLeaf(uint32_t node) const { return nodes_[node].past == node + 1; }
  void divide(const LeafPair& nodes, std::vector<LeafPair>& leaves, std::vector<LeafPair>& open) const;
  bool inOneGroup(uint32_t a, uint32_t b) const { return nodes_[a].group == nodes_[b].group && nodes_[a].group != kMixed; }
  Reaching reaching(const Node& leaf, const LooseBox& box) const;

  LargeVector<Item> items_;       // by group, in the mesh's order
  std::vector<uint32_t> starts_;  // per group: where its items start
  LargeVector<Node> nodes_;
};

template <class F>
void TriangleTree::forOverlapping(const LeafPair& leaves, const F& f) const {
  const bool same = leaves[0] == leaves[1];
  const Node &first = nodes_[leaves[0]], &second = nodes_[leaves[1]];
  const Reaching b = reaching(second, first.box);
  if (b.count == 0) return;
  const Reaching a = same ? b : reaching(first, second.box);
  for (uint32_t i = 0; i < a.count; ++i) {
    for (uint32_t j = same ? i + 1 : 0; j < b.count; ++j) {
      const Item &s = *a.items[i], &t = *b.items[j];
      if (s.group != t.group && s.box.overlaps(t.box)) f(s.triangle, t.triangle);
    }
  }
}

}  // namespace mandoline::detail
