#include "mesh/parts.h"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "mesh/prepared.h"

namespace mandoline::detail {
namespace {

/// One use of a tri-edge by a triangle.
struct TriangleUse {
  uint32_t triangleAndWay;  ///< 2 * triangle, + 1 if it runs through the edge from the lower end

  uint32_t triangle() const { return triangleAndWay / 2; }
  int32_t sign() const { return triangleAndWay % 2 != 0 ? 1 : -1; }
};

/// The uses of each tri-edge. Nearly all edges have two at most, which are kept apart from those of the others.
class EdgeUses {
 public:
  explicit EdgeUses(const Prepared& prepared) : counts_(prepared.edges.ends.size(), 0), few_(counts_.size()) {
    forUses(prepared, [counts = counts_.data(), few = few_.data()](uint32_t edge, TriangleUse use) {
      if (counts[edge] < 2) few[edge][counts[edge]] = use;
      ++counts[edge];
    });
    uint32_t crowded = 0;
    for (uint32_t edge = 0; edge < counts_.size(); ++edge) {
      if (isCrowded(edge)) few_[edge][0].triangleAndWay = crowded++;  // where its own are
    }
    if (crowded > 0) findMany(prepared, crowded);
  }

  uint32_t edgeCount() const { return uint32_t(counts_.size()); }
  std::span<const TriangleUse> operator[](uint32_t edge) const {
    if (isCrowded(edge)) return many_[few_[edge][0].triangleAndWay];
    return {few_[edge].data(), counts_[edge]};
  }

 private:
  bool isCrowded(uint32_t edge) const { return counts_[edge] > 2; }

  /// Calls f(edge, use) for all.
  template <class F>
  static void forUses(const Prepared& prepared, const F& f) {
    const bool isPlain = prepared.duplicates.empty() && prepared.edges.stitched.size() == 0;
    const uint32_t* edge = prepared.edges.sideEdges.data();
    for (uint32_t t = 0; t < prepared.triangles.size(); ++t, edge += 3) {
      if (!prepared.kept(t)) continue;
      if (isPlain) {
        const auto& [a, b, c] = prepared.triangles[t];
        f(edge[0], TriangleUse{2 * t + (a < b)});
        f(edge[1], TriangleUse{2 * t + (b < c)});
        f(edge[2], TriangleUse{2 * t + (c < a)});
      } else {
        forUsesOf({t}, prepared, f);
      }
    }
  }
  template <class F>
  static void forUsesOf(TriangleId t, const Prepared& prepared, const F& f) {
    const std::span<const Duplicate> duplicates = prepared.duplicatesOf(t);
    for (int side = 0; side < 3; ++side) {
      prepared.edges.forSide(prepared, t, side, [&](TriEdgeId edge, bool forward) {
        f(edge.number, TriangleUse{2 * t.number + forward});
        for (const Duplicate& d : duplicates) f(edge.number, TriangleUse{2 * d.triangle + (forward == d.sameWay)});
      });
    }
  }
  void findMany(const Prepared& prepared, uint32_t crowded) {
    struct Given {
      uint32_t at;
      TriangleUse use;
    };
    std::vector<Given> given;
    forUses(prepared, [&](uint32_t edge, TriangleUse use) {
      if (isCrowded(edge)) given.push_back({few_[edge][0].triangleAndWay, use});
    });
    many_ = groupBy<TriangleUse>(
        crowded, given.size(), [&](size_t i) { return size_t(given[i].at); }, [&](size_t i) { return given[i].use; });
  }

  std::vector<uint32_t> counts_;                 // per edge
  std::vector<std::array<TriangleUse, 2>> few_;  // per edge that has no more; of the others, first, their numbers in many_
  Csr<TriangleUse> many_;
};

/// What the triangles of one set do at an edge.
struct Share {
  uint32_t set;  ///< its root
  int32_t sum;   ///< of the signs of their uses
  uint32_t count;

  bool isOdd() const { return count % 2 != 0; }
};

class PartFinder {
 public:
  explicit PartFinder(const Prepared& prepared)
      : prepared_(prepared), uses_(prepared), sets_(prepared.triangles.size()), copied_(prepared.triangles.size(), 0) {
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
  void findActive(uint32_t edge) {
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
  void findNeedy(uint32_t edge) {
    shares_.clear();
    if (uses_[edge].size() < 3) return;
    findActive(edge);
    findShares(active_);
    int32_t sum = 0;
    for (const TriangleUse& use : active_) sum += use.sign();
    const bool isEven = active_.size() % 2 == 0;
    std::erase_if(shares_, [&](const Share& share) { return sum == 0 ? share.sum == 0 : !isEven || !share.isOdd(); });
  }

  /// Joins triangles at edges that have just two uses, set by set from its lowest triangle on, which is its root.
  void joinPairs() {
    for (uint32_t edge = 0; edge < uses_.edgeCount(); ++edge) {
      if (uses_[edge].size() != 2) others_.push_back(edge);
    }
    std::vector<uint8_t> isReached(prepared_.triangles.size(), 0);
    std::vector<TriangleId> reached;  // but not looked at
    for (const TriangleId lowest : prepared_.triangleIds()) {
      if (std::exchange(isReached[lowest.number], 1)) continue;
      for (reached.assign(1, lowest); !reached.empty();) {
        const TriangleId t = reached.back();
        reached.pop_back();
        if (!prepared_.kept(t)) continue;  // what a duplicate would reach, the original does
        prepared_.edges.forTriangle(t, [&](TriEdgeId edge) {
          const std::span<const TriangleUse> uses = uses_[edge.number];
          if (uses.size() != 2) return;
          const uint32_t first = uses[0].triangle(), other = first == t.number ? uses[1].triangle() : first;
          if (isReached[other] || uses[other == first].triangle() != t.number) return;  // not of its sides
          isReached[other] = 1;
          sets_.unite(lowest.number, other);
          reached.push_back({other});
        });
      }
    }
  }

  /// Where exactly two sets need each other there is no choice, in whichever order it is done.
  bool joinTwo() {
    bool any = false, again = true;
    while (again) {
      again = false;
      for (const uint32_t edge : others_) {
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
    for (const uint32_t edge : others_) {
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
    for (uint32_t edge = 0; edge < uses_.edgeCount(); ++edge) {
      const std::span<const TriangleUse> uses = uses_[edge];
      if (uses.size() == 2 && uses[0].sign() == uses[1].sign()) worsen(sets_.find(uses[0].triangle()), PartKind::parity);
    }
    for (const uint32_t edge : others_) {
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
    for (const uint32_t edge : others_) {
      findShares(uses_[edge]);
      if (std::none_of(shares_.begin(), shares_.end(), [](const Share& share) { return share.isOdd(); })) continue;
      ++result.counts.openEdges;
      const auto& [low, high] = prepared_.edges.ends[TriEdgeId{edge}];
      isEnd[low.number] = isEnd[high.number] = 1;
      chains.unite(low.number, high.number);
    }
    for (uint32_t v = 0; v < isEnd.size(); ++v) result.counts.holes += isEnd[v] && chains.find(v) == v;
  }

  const Prepared& prepared_;
  EdgeUses uses_;
  DisjointSets sets_;                // of triangles
  std::vector<uint8_t> copied_;      // per triangle: whether another has its vertices
  std::vector<uint32_t> others_;     // edges that have not just two uses
  std::vector<TriangleUse> active_;  // of the edge at hand
  std::vector<Share> shares_;
};

}  // namespace

Parts findParts(const Prepared& prepared) { return PartFinder(prepared).run(); }

}  // namespace mandoline::detail
