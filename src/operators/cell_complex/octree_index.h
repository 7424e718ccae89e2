// Octree cells by the grid cells that they hold: as OctreeCells::find(), in constant time.
#pragma once

#include <algorithm>
#include <optional>

#include "base/ranked_set.h"
#include "mandoline/coarsen.h"

namespace mandoline::operators {

using GridIndex = std::array<int32_t, 3>;

/// Keeps a reference to the octree cells.
class OctreeIndex {
 public:
  explicit OctreeIndex(const OctreeCells& octree)
      : octree_(octree),
        corners_(numberOf({octree.gridCells[0] - 1, octree.gridCells[1] - 1, octree.gridCells[2] - 1}) + 1, octree.cellCount()) {
    for (size_t c = 0; c < octree.cellCount(); ++c) {
      corners_.insert(numberOf(octree.corner(c)));
      highest_ = std::max(highest_, int(octree.cellLevel[c]));
    }
    corners_.rank();
    cells_.resize(corners_.size());
    for (size_t c = 0; c < octree.cellCount(); ++c) cells_[corners_.rankOf(numberOf(octree.corner(c)))] = uint32_t(c);
  }

  /// The octree cell of at least this level that holds a grid cell of the grid, or -1.
  int64_t find(const GridIndex& at, int level) const {
    for (; level <= highest_; ++level) {
      GridIndex corner = at;
      for (int32_t& x : corner) x = x >> level << level;
      const uint32_t rank = corners_.rankOf(numberOf(corner));
      if (rank != corners_.kNone && octree_.cellLevel[cells_[rank]] >= level) return cells_[rank];
    }
    return -1;
  }

  /// The octree cell across a side of another one, or -1 outside the grid. Nothing if smaller cells, cut-cells, or a cell of its size that
  /// comes before it, have the faces there.
  std::optional<int64_t> acrossSide(size_t c, size_t axis, int side) const {
    GridIndex across = octree_.corner(c);
    const int level = octree_.cellLevel[c];
    across[axis] += side ? 1 << level : -1;
    if (across[axis] < 0 || across[axis] >= octree_.gridCells[axis]) return -1;
    const int64_t neighbour = find(across, level);
    if (neighbour < 0 || (side == 0 && octree_.cellLevel[size_t(neighbour)] == level)) return {};
    return neighbour;
  }

 private:
  uint64_t numberOf(const GridIndex& at) const {
    const auto& cells = octree_.gridCells;
    return (uint64_t(at[2]) * uint64_t(cells[1]) + uint64_t(at[1])) * uint64_t(cells[0]) + uint64_t(at[0]);
  }

  const OctreeCells& octree_;
  detail::RankedSet corners_;
  std::vector<uint32_t> cells_;  // by the ranks of their corners
  int highest_ = 0;              // level
};

}  // namespace mandoline::operators
