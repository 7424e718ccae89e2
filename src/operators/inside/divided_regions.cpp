#include "operators/inside/divided_regions.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "operators/inside/neighbours.h"

namespace mandoline::operators {
namespace {

using GridCell = std::array<int32_t, 3>;

/// Nodes are the cut-cells, then the octree cells.
class Divider {
 public:
  Divider(const CutMesh& cutMesh, const OctreeCells& octree, const std::vector<int32_t>& owners, const std::vector<int32_t>& labels)
      : cutMesh_(cutMesh),
        octree_(octree),
        owners_(owners),
        labels_(labels),
        firstOctree_(uint32_t(cutMesh.cellCount())),
        nodes_(labels.size()) {}

  DividedRegions run() {
    forEachNeighbours(cutMesh_, octree_, owners_, [&](uint32_t a, uint32_t b) {
      if (labels_[a] == labels_[b]) nodes_.unite(a, b);
    });
    number();
    return std::move(result_);
  }

 private:
  GridCell gridCellOf(size_t cell) const {
    const int32_t* at = &cutMesh_.cellGridCell[3 * cell];
    return {at[0], at[1], at[2]};
  }

  /// Row by row, cut-cells and runs in the order of their grid cells.
  void number() {
    const int64_t ny = cutMesh_.grid.cells(1), rows = int64_t(cutMesh_.rowRunOffsets.size()) - 1;
    regionOf_.assign(labels_.size(), kUnset);
    result_.cellRegion.resize(firstOctree_);
    result_.octreeRegion.resize(octree_.cellCount());
    result_.rowRunOffsets.push_back(0);
    size_t cell = 0;
    for (int64_t row = 0; row < rows; ++row) {
      const int32_t j = int32_t(row % ny), k = int32_t(row / ny);
      const auto takeCells = [&](int32_t before) {
        for (; cell < firstOctree_; ++cell) {
          const GridCell at = gridCellOf(cell);
          if (at[1] != j || at[2] != k || at[0] >= before) return;
          result_.cellRegion[cell] = label(uint32_t(cell));
        }
      };
      for (uint32_t r = cutMesh_.rowRunOffsets[size_t(row)]; r < cutMesh_.rowRunOffsets[size_t(row) + 1]; ++r) {
        takeCells(cutMesh_.runBegin[r]);
        addRuns(r, j, k);
      }
      takeCells(int32_t(cutMesh_.grid.cells(0)));
      result_.rowRunOffsets.push_back(uint32_t(result_.runBegin.size()));
    }
    for (uint32_t c = 0; c < octree_.cellCount(); ++c) result_.octreeRegion[c] = label(firstOctree_ + c);
  }

  /// The parts of a run that lie in different regions.
  void addRuns(uint32_t run, int32_t j, int32_t k) {
    const int32_t end = cutMesh_.runEnd[run];
    bool isFirst = true;
    for (int32_t i = cutMesh_.runBegin[run]; i < end; isFirst = false) {
      const size_t cell = size_t(octree_.find(i, j, k));
      const uint32_t region = label(firstOctree_ + uint32_t(cell));
      const int32_t past = std::min(end, octree_.end(cell)[0]);
      if (!isFirst && result_.runRegion.back() == region) {
        result_.runEnd.back() = past;
      } else {
        result_.runBegin.push_back(i);
        result_.runEnd.push_back(past);
        result_.runRegion.push_back(region);
      }
      i = past;
    }
  }

  uint32_t label(uint32_t node) {
    uint32_t& region = regionOf_[nodes_.find(node)];
    if (region == kUnset) region = result_.count++;
    return region;
  }

  static constexpr uint32_t kUnset = ~0u;

  const CutMesh& cutMesh_;
  const OctreeCells& octree_;
  const std::vector<int32_t>&owners_, &labels_;
  uint32_t firstOctree_;
  detail::DisjointSets nodes_;
  std::vector<uint32_t> regionOf_;  // per root
  DividedRegions result_;
};

}  // namespace

DividedRegions divideRegions(const CutMesh& cutMesh, const OctreeCells& octree, const std::vector<int32_t>& owners,
                             const std::vector<int32_t>& labels) {
  return Divider(cutMesh, octree, owners, labels).run();
}

}  // namespace mandoline::operators
