// Blocks of grid cells, of sides of 2^level, that have smaller ones inside: an octree by its inner nodes.
#pragma once

#include <array>
#include <vector>

#include "base/function_ref.h"
#include "base/parallel.h"
#include "base/shared.h"
#include "mandoline/coarsen.h"
#include "operators/coarsen/morton_order.h"

namespace mandoline::operators {

/// A block of grid cells of some level: its lowest grid cell, divided by the block's size.
using Block = std::array<int32_t, 3>;
using Blocks = std::vector<Block>;  // ascending along the Morton curve, each once

/// One of the eight blocks of half the size in a block, in Morton order.
inline Block childOf(const Block& block, int32_t child) {
  return {2 * block[0] + (child & 1), 2 * block[1] + (child >> 1 & 1), 2 * block[2] + (child >> 2)};
}
/// An octree cell as the block of its level.
inline Block blockOf(const OctreeCells& octree, size_t cell) {
  Block block = octree.corner(cell);
  for (int32_t& x : block) x >>= octree.cellLevel[cell];
  return block;
}

struct BlockTree {
  std::array<int32_t, 3> gridCells{};
  std::vector<Blocks> divided;  ///< per level; those of level 0 are left out

  bool inGrid(const Block& block, int level) const {
    bool inside = true;
    for (size_t d = 0; d < 3; ++d) inside &= block[d] >= 0 && int64_t(block[d]) << level < gridCells[d];
    return inside;
  }
  /// The level of a block that holds the grid.
  int top() const;

  /// The blocks of a level with blocks of the level below that are among these or in a layer around one.
  Blocks parentsAround(Blocks blocks, int level, int32_t layers) const;

  /// Fills in the levels above `from`, up to the last, around the blocks of that level that are kept as they are or divided.
  void divideAbove(int from, const Blocks& kept, const CoarsenOptions& options, detail::Monitor& monitor);

  /// Calls visit(block, level) for all blocks that are not divided, up to the last level, in Morton order, in which all lists of blocks
  /// are.
  using Visit = detail::FunctionRef<void(const Block&, int)>;
  void forLeaves(Visit visit) const;

 private:
  void addParents(const Block& block, int level, bool balanceEdges);
  void forLeavesIn(const Block& block, int level, std::vector<size_t>& next, Visit visit) const;
};

/// The grid cells that have cut-cells.
Blocks cutBlocks(const CutMesh& cutMesh);
/// The same from the runs alone: those that are in none.
Blocks cutBlocksByRuns(const CutMesh& cutMesh);

/// The options with layersPerLevel as it is meant for a grid. Throws CallError if an option is negative.
MANDOLINE_SHARED CoarsenOptions meantFor(const Grid& grid, CoarsenOptions options);

}  // namespace mandoline::operators
