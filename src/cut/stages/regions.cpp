#include "cut/stages/regions.h"

#include "base/sort.h"
#include "cut/stages/winding.h"

namespace mandoline::detail {
namespace {

/// Joins nodes into regions. Nodes are the components of all bricks, then the runs.
class RegionFinder {
 public:
  explicit RegionFinder(const CutBricks& cut) : input_(cut.surface.input), cut_(cut), runs_(cut.runs), cuts_(cut.cuts) {
    for (const BrickCut& cut : cuts_) {
      firstNodes_.push_back(firstRun_);
      firstRun_ += cut.componentCount;
    }
    nodes_.reset(firstRun_ + runs_.size());
  }

  void run(Regions& regions) {
    runs_.forNeighbours([&](uint32_t a, uint32_t b) { nodes_.unite(firstRun_ + a, firstRun_ + b); });
    for (const BrickId b : cuts_.ids()) uniteBrick(b);
    number(regions);
  }

 private:
  void uniteBrick(BrickId brick) {
    for (const SeamJoin& join : cut_.seams[brick].joins) nodes_.unite(firstNodes_[brick] + join.component, firstRun_ + join.run);
    std::array<uint32_t, 2> last{~0u, ~0u};  // what lies beside each other often does so again and again
    cut_.forHalves(brick, [&](const BoundaryHalf& below, BrickId owner, const BoundaryHalf& above) {
      if (below.isTri) return;
      const std::array<uint32_t, 2> pair{firstNodes_[owner] + below.component, firstNodes_[brick] + above.component};
      if (pair != last) nodes_.unite(pair[0], pair[1]);
      last = pair;
    });
  }

  /// Where a node begins: by grid cells, and among the cut-cells of one, which all lie in one brick, by their order.
  struct Begin {
    uint64_t gridCell;
    uint32_t node;
    auto operator<=>(const Begin&) const = default;
  };

  void number(Regions& regions) {
    constexpr uint32_t kUnset = ~0u;
    const Begin last{~uint64_t(0), kUnset};
    std::vector<Begin> begins(nodes_.size(), last);  // per root
    const auto note = [&](uint64_t row, uint64_t x, uint32_t node) {
      Begin& begin = begins[nodes_.find(node)];
      begin = std::min(begin, {row * uint64_t(input_.cells(0)) + x, node});
    };
    for (const BrickId b : cuts_.ids()) {
      uint32_t next = 0;
      for (const CellId c : cuts_[b].gridCells.ids()) {
        if (next == cuts_[b].componentCount) break;
        if (cut_.bricks.here.has(b) && cuts_[b].components[c] != next) continue;
        const Slab cell = cut_.bricks.boxes[b].cellAt(cuts_[b].gridCells[c]);
        note(runs_.rowOf(cell), uint64_t(cell[0] >> 1), firstNodes_[b] + next++);
      }
    }
    for (size_t row = 0; row + 1 < runs_.rowOffsets.size(); ++row) {
      for (uint32_t r = runs_.rowOffsets[row]; r < runs_.rowOffsets[row + 1]; ++r) note(row, uint64_t(runs_.begin[r]), firstRun_ + r);
    }
    begins.erase(std::remove(begins.begin(), begins.end(), last), begins.end());
    sortItems(begins);
    regions.count = uint32_t(begins.size());
    std::vector<uint32_t> regionOf(nodes_.size());  // per root
    for (uint32_t r = 0; r < begins.size(); ++r) regionOf[nodes_.find(begins[r].node)] = r;
    for (const BrickId b : cuts_.ids()) {
      std::vector<uint32_t> ofComponents;
      for (uint32_t c = 0; c < cuts_[b].componentCount; ++c) ofComponents.push_back(regionOf[nodes_.find(firstNodes_[b] + c)]);
      regions.ofComponents.push_back(std::move(ofComponents));
    }
    regions.runRegion.resize(runs_.size());
    for (uint32_t r = 0; r < runs_.size(); ++r) regions.runRegion[r] = regionOf[nodes_.find(firstRun_ + r)];
  }

  const Input& input_;
  const CutBricks& cut_;
  const UntouchedRuns& runs_;
  const IdVector<BrickId, BrickCut>& cuts_;
  IdVector<BrickId, uint32_t> firstNodes_;
  uint32_t firstRun_ = 0;
  DisjointSets nodes_;
};

}  // namespace

Regions findRegions(const CutBricks& cut) {
  Regions regions;
  RegionFinder(cut).run(regions);
  findWinding(cut, regions);
  return regions;
}

}  // namespace mandoline::detail
