// Cells are joined in the order in which they exchange most per difference of phi. What is joined then differs in phi by at most what flows
// into it by rounding errors, over what the strongest link to others exchanges. As a maximum spanning tree is found, by Kruskal.
#include "physics/unresolved_cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/shared_sets.h"
#include "operators/measure/vector.h"

namespace mandoline::physics {
namespace {

struct Link {
  double strength;  ///< what flows per difference of phi
  uint32_t a, b;
};

/// Per cell, of what flows into it through the boundary.
std::vector<double> roundingErrors(const PoissonSetup& setup, const detail::Team& team) {
  constexpr double kRounding = 1e-15;
  const CellComplex& cells = setup.cells;
  const Boundary& boundary = setup.problem.boundary;
  std::vector<double> sum(cells.cellCount()), largest(cells.cellCount());
  for (size_t b = 0; b < setup.terms.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    const auto c = size_t(cells.faceCells[h]);
    const double flow = std::fabs(setup.terms[b].perValue * boundary.value[b]), area = cells.faceArea[h / 2];
    sum[c] += flow;
    if (area > 0) largest[c] = std::max(largest[c], flow / area);
  }
  forBlocks(sum.size(), team, [&](size_t begin, size_t end) {
    for (size_t c = begin; c < end; ++c) {
      if (sum[c] == 0) continue;
      Point open{};  // the sum of area vectors, zero but for rounding of positions
      for (const uint32_t h : cells.halfFaces(c)) {
        for (size_t d = 0; d < 3; ++d) open[d] += (h % 2 == 0 ? 1 : -1) * cells.faceArea[h / 2] * cells.faceNormal[3 * (h / 2) + d];
      }
      sum[c] = kRounding * sum[c] + largest[c] * measuring::length(open);
    }
  });
  return sum;
}

class Joiner {
 public:
  Joiner(const PoissonSetup& setup, double limit, const detail::Team& team)
      : setup_(setup), cells_(setup.cells), limit_(limit), team_(team) {}

  std::vector<uint32_t> run() {
    error_ = roundingErrors(setup_, team_);
    ownStrength_ = ownStrengths();
    double all = 0;
    for (const double error : error_) all += error;
    findWeak(all);
    if (weak_.empty()) return {};
    joinStrong(all);
    std::sort(weak_.begin(), weak_.end(), [](const Link& a, const Link& b) {
      return a.strength != b.strength ? a.strength > b.strength : a.a != b.a ? a.a < b.a : a.b < b.b;
    });
    for (const Link& link : weak_) join(link);
    return open();
  }

 private:
  /// What each cell exchanges with others, but for those larger ones that it meets beside smaller ones.
  std::vector<double> ownStrengths() const {
    std::vector<double> sum = setup_.added;
    forBlocks(sum.size(), team_, [&](size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        for (const uint32_t e : setup_.edgesOfCells[c]) {
          const DualEdge& edge = setup_.dual.edges[e];
          if (edge.cell == c || setup_.dual.faces[e].size() == 1) sum[c] += edge.flow / edge.distance;
        }
      }
    });
    return sum;
  }

  /// Where a cell meets several smaller ones, a dual edge links it to the largest of them, as well as this is held itself: of all of them
  /// it holds only the mean.
  Link linkOf(size_t e) const {
    const DualEdge& edge = setup_.dual.edges[e];
    uint32_t largest = otherCell(cells_, edge, setup_.dual.faces[e][0]);
    for (const uint32_t face : setup_.dual.faces[e]) {
      const uint32_t other = otherCell(cells_, edge, face);
      if (cells_.cellVolume[other] > cells_.cellVolume[largest]) largest = other;
    }
    const double strength = edge.flow / edge.distance;
    return {setup_.dual.faces[e].size() == 1 ? strength : std::min(strength, ownStrength_[largest]), edge.cell, largest};
  }
  /// To the ground, which is numbered after all cells.
  template <class F>
  void forLinksToGround(const F& f) const {
    for (uint32_t c = 0; c < cells_.cellCount(); ++c) {
      if (setup_.added[c] > 0) f(Link{setup_.added[c], c, ground()});
    }
  }
  uint32_t ground() const { return uint32_t(cells_.cellCount()); }

  void findWeak(double all) {
    detail::Monitor monitor(team_.size());
    const auto add = [&](const Link& link, std::vector<Link>& weak) {
      if (link.strength * limit_ < all) weak.push_back(link);
    };
    const auto parts = detail::forChunks<std::vector<Link>>(setup_.dual.edges.size(), monitor, [&](auto& weak, size_t begin, size_t end) {
      for (size_t e = begin; e < end; ++e) add(linkOf(e), weak);
    });
    for (const std::vector<Link>& part : parts) weak_.insert(weak_.end(), part.begin(), part.end());
    forLinksToGround([&](const Link& link) { add(link, weak_); });
  }

  void joinStrong(double all) {
    sets_ = detail::SharedSets(cells_.cellCount() + 1);
    const auto join = [&](const Link& link) {
      if (link.strength * limit_ >= all) sets_.unite(link.a, link.b);
    };
    forBlocks(setup_.dual.edges.size(), team_, [&](size_t begin, size_t end) {
      for (size_t e = begin; e < end; ++e) join(linkOf(e));
    });
    forLinksToGround(join);
    error_.push_back(0);
    volume_ = cells_.cellVolume;
    volume_.push_back(HUGE_VAL);
    for (uint32_t c = 0; c <= ground(); ++c) {
      const uint32_t set = sets_.find(c);
      if (set != c) error_[set] += error_[c], volume_[set] += volume_[c];
      strong_.push_back(set), parent_.push_back(c);
    }
    part_ = parent_;
    isOpen_.resize(parent_.size());
  }

  /// Both differ from their mean, which others hold or which is zero: the smaller part more.
  void join(const Link& link) {
    uint32_t small = sets_.find(link.a), large = sets_.find(link.b);
    if (small == large) return;
    if (volume_[small] > volume_[large]) std::swap(small, large);
    const double volume = volume_[small] + volume_[large], error = error_[small] + error_[large];
    const double difference = error_[small] / link.strength;
    isOpen_[part_[small]] = difference > limit_;
    isOpen_[part_[large]] = std::isfinite(volume) && difference * volume_[small] > limit_ * volume;
    const auto whole = uint32_t(parent_.size());
    parent_[part_[small]] = parent_[part_[large]] = whole;
    parent_.push_back(whole), isOpen_.push_back(0);
    sets_.unite(small, large);
    const uint32_t set = sets_.find(small);
    volume_[set] = volume, error_[set] = error, part_[set] = whole;
  }

  std::vector<uint32_t> open() {
    for (size_t part = parent_.size(); part-- > 0;) isOpen_[part] |= isOpen_[parent_[part]];
    std::vector<uint32_t> result;
    for (uint32_t c = 0; c < ground(); ++c) {
      if (isOpen_[strong_[c]]) result.push_back(c);
    }
    return result;
  }

  const PoissonSetup& setup_;
  const CellComplex& cells_;
  double limit_;
  const detail::Team& team_;
  std::vector<double> ownStrength_;
  std::vector<Link> weak_;
  detail::SharedSets sets_;                // of cells that are joined
  std::vector<double> error_, volume_;     // per set, by its root
  std::vector<uint32_t> part_;             // per set: the last part of the tree
  std::vector<uint32_t> strong_, parent_;  // per cell: the set that strong links join it to; per part: that which it joined
  std::vector<char> isOpen_;               // per part
};

}  // namespace

std::vector<uint32_t> unresolvedCells(const PoissonSetup& setup, double limit, const detail::Team& team) {
  return Joiner(setup, limit, team).run();
}

}  // namespace mandoline::physics
