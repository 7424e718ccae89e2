#include "mesh/parts.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "mesh/prepared.h"

namespace mandoline::detail {
namespace {

/// What the triangles of one set do at an edge.
struct Share {
  uint32_t set;  ///< its root
  int32_t sum;   ///< of the signs of their uses
  uint32_t count;

  bool isOdd() const { return count % 2 != 0; }
};

class PartFinder {
 public:
  PartFinder(const Prepared& prepared, const EdgeUses& uses)
      : prepared_(prepared), uses_(uses), sets_(prepared.triangles.size()), copied_(prepared.triangles.size(), 0) {
    for (const Duplicate& d : prepared.duplicates) copied_[d.original] = copied_[d.triangle] = 1;
  }

  Parts run() {
    joinPairs();
    while (joinTwo() || joinMany()) {
    }
    return classify();
  }

 private:
  /// The uses that may join: where they don't cancel, copies of triangles are in excess and left alone, so that a triangle that lies twice
  /// in a closed surface does not open it.
  void findActive(TriEdgeId edge) {
    const std::span<const TriangleUse> uses = uses_[edge];
    active_.assign(uses.begin(), uses.end());
    int32_t sum = 0;
    for (const TriangleUse& use : uses) sum += use.sign();
    if (sum == 0 || prepared_.duplicates.empty()) return;
    sortItems(active_, [](const TriangleUse& a, const TriangleUse& b) { return a.triangleAndWay > b.triangleAndWay; });
    std::erase_if(active_, [&](const TriangleUse& use) {
      const bool isExcess = sum * use.sign() > 0 && copied_[use.triangle()];
      if (isExcess) sum -= use.sign();
      return isExcess;
    });
  }

  void findShares(std::span<const TriangleUse> uses) {
    shares_.clear();
    for (const TriangleUse& use : uses) shares_.push_back({sets_.find(use.triangle()), use.sign(), 1});
    sortItems(shares_, [](const Share& a, const Share& b) { return a.set < b.set; });
    size_t kept = 0;
    for (size_t i = 1; i < shares_.size(); ++i) {
      if (shares_[i].set != shares_[kept].set) {
        shares_[++kept] = shares_[i];
      } else {
        shares_[kept].sum += shares_[i].sum;
        ++shares_[kept].count;
      }
    }
    shares_.resize(uses.empty() ? 0 : kept + 1);
  }

  /// The sets that need each other at an edge. Where its uses cancel, those whose own don't; where their number is even at least, those
  /// whose own is odd; elsewhere nothing can be closed.
  void findNeedy(TriEdgeId edge) {
    shares_.clear();
    if (uses_[edge].size() < 3) return;
    findActive(edge);
    findShares(active_);
    int32_t sum = 0;
    for (const TriangleUse& use : active_) sum += use.sign();
    const bool isEven = active_.size() % 2 == 0;
    std::erase_if(shares_, [&](const Share& share) { return sum == 0 ? share.sum == 0 : !isEven || !share.isOdd(); });
  }

  /// Joins triangles at edges that have just two uses.
  void joinPairs() {
    for (const TriEdgeId edge : Ids<TriEdgeId>(uses_.size())) {
      const std::span<const TriangleUse> uses = uses_[edge];
      if (uses.size() == 2) {
        sets_.unite(uses[0].triangle(), uses[1].triangle());
      } else {
        others_.push_back(edge);
      }
    }
  }

  /// Where exactly two sets need each other there is no choice, in whichever order it is done.
  bool joinTwo() {
    bool any = false, again = true;
    while (again) {
      again = false;
      for (const TriEdgeId edge : others_) {
        findNeedy(edge);
        if (shares_.size() != 2) continue;
        sets_.unite(shares_[0].set, shares_[1].set);
        any = again = true;
      }
    }
    return any;
  }

  /// Of several that need each other nobody can tell which: they are one part. All edges are looked at before any are joined, so
  /// that their order does not matter.
  bool joinMany() {
    std::vector<std::array<uint32_t, 2>> pairs;
    for (const TriEdgeId edge : others_) {
      findNeedy(edge);
      for (size_t i = 1; i < shares_.size(); ++i) pairs.push_back({shares_[0].set, shares_[i].set});
    }
    for (const auto& [a, b] : pairs) sets_.unite(a, b);
    return !pairs.empty();
  }

  Parts classify() {
    const size_t n = prepared_.triangles.size();
    std::vector<PartKind> kinds(n, PartKind::winding);  // of roots
    const auto worsen = [&](uint32_t root, PartKind kind) { kinds[root] = std::max(kinds[root], kind); };
    for (const TriEdgeId edge : Ids<TriEdgeId>(uses_.size())) {
      const std::span<const TriangleUse> uses = uses_[edge];
      if (uses.size() == 2 && uses[0].sign() == uses[1].sign()) worsen(sets_.find(uses[0].triangle()), PartKind::parity);
    }
    for (const TriEdgeId edge : others_) {
      findShares(uses_[edge]);
      for (const Share& share : shares_) {
        if (share.sum != 0) worsen(share.set, share.isOdd() ? PartKind::open : PartKind::parity);
      }
    }
    Parts result;
    result.kinds.assign(n, PartKind::none);
    for (uint32_t t = 0; t < n; ++t) {
      if (prepared_.states[t] == TriangleState::zeroArea) continue;
      const uint32_t root = sets_.find(t);
      result.kinds[t] = kinds[root];
      PartCounts& counts = result.counts;
      if (root == t) ++(kinds[t] == PartKind::winding ? counts.winding : kinds[t] == PartKind::parity ? counts.parity : counts.open);
    }
    if (result.counts.open > 0) countOpenEdges(result);
    return result;
  }

  /// And the connected sets of them.
  void countOpenEdges(Parts& result) {
    DisjointSets chains(prepared_.points.size());
    std::vector<uint8_t> isEnd(prepared_.points.size(), 0);
    for (const TriEdgeId edge : others_) {
      findShares(uses_[edge]);
      if (std::none_of(shares_.begin(), shares_.end(), [](const Share& share) { return share.isOdd(); })) continue;
      ++result.counts.openEdges;
      const auto& [low, high] = prepared_.edges.ends[edge];
      isEnd[low.number] = isEnd[high.number] = 1;
      chains.unite(low.number, high.number);
    }
    for (uint32_t v = 0; v < isEnd.size(); ++v) result.counts.holes += isEnd[v] && chains.find(v) == v;
  }

  const Prepared& prepared_;
  const EdgeUses& uses_;
  DisjointSets sets_;                // of triangles
  std::vector<uint8_t> copied_;      // per triangle: whether another has its vertices
  std::vector<TriEdgeId> others_;    // edges that have not just two uses
  std::vector<TriangleUse> active_;  // of the edge at hand
  std::vector<Share> shares_;
};

}  // namespace

Parts findParts(const Prepared& prepared, const EdgeUses& uses) { return PartFinder(prepared, uses).run(); }

}  // namespace mandoline::detail
