#include "operators/coarsen/block_tree.h"

#include <algorithm>

#include "base/sort.h"
#include "mandoline/status.h"

namespace mandoline::operators {

int BlockTree::top() const {
  int level = 0;
  while (inGrid({1, 0, 0}, level) || inGrid({0, 1, 0}, level) || inGrid({0, 0, 1}, level)) ++level;
  return level;
}

void BlockTree::divideAbove(int from, const Blocks& kept, const CoarsenOptions& options, detail::Monitor& monitor) {
  const int last = int(divided.size()) - 1;
  if (last <= from) return;
  const size_t first = size_t(from) + 1;
  divided[first] = parentsAround(kept, from + 1, options.fineLayers);
  if (from > 0) {
    for (const Block& block : divided[size_t(from)]) addParents(block, from + 1, options.balanceEdges);
    detail::sortUnique(divided[first], isBefore);
  }
  for (int level = from + 2; level <= last; ++level) {
    monitor.report(size_t(level - from), size_t(last - from));
    const Blocks& inside = divided[size_t(level) - 1];
    const int most = options.layersPerLevel, layers = level == from + 2 ? std::min(most, std::max(2, most / 4)) : most;
    if (layers > 0) divided[size_t(level)] = parentsAround(inside, level, layers);
    for (const Block& block : inside) addParents(block, level, options.balanceEdges);
    detail::sortUnique(divided[size_t(level)], isBefore);
  }
}

/// Divides the parent of a divided block, and those of its neighbours, which must not be larger than it: along each axis one neighbour
/// has another parent.
void BlockTree::addParents(const Block& block, int level, bool balanceEdges) {
  const Block parent = {block[0] >> 1, block[1] >> 1, block[2] >> 1};
  for (int axes = 0; axes < 7; ++axes) {  // the set of axes along which to step
    const bool isFace = (axes & (axes - 1)) == 0;
    if (!isFace && !balanceEdges) continue;
    Block neighbour = parent;
    for (size_t d = 0; d < 3; ++d) {
      if (axes >> d & 1) neighbour[d] += block[d] % 2 == 0 ? -1 : 1;
    }
    if (inGrid(neighbour, level)) divided[size_t(level)].push_back(neighbour);
  }
}

Blocks BlockTree::parentsAround(Blocks blocks, int level, int32_t layers) const {
  for (size_t d = 0; d < 3; ++d) {  // numbers of blocks become numbers of parents, axis by axis
    const int32_t end = (gridCells[d] - 1) >> (level - 1);
    Blocks spread;
    for (const Block& block : blocks) {
      Block at = block;
      const int32_t last = (block[d] + std::min(layers, end - block[d])) >> 1;
      for (at[d] = (block[d] - std::min(layers, block[d])) >> 1; at[d] <= last; ++at[d]) spread.push_back(at);
    }
    detail::sortUnique(spread, isBefore);
    blocks = std::move(spread);
  }
  return blocks;
}

void BlockTree::forLeaves(Visit visit) const {
  std::vector<size_t> next(divided.size());
  forLeavesIn({0, 0, 0}, std::max(top(), int(divided.size()) - 1), next, visit);
}

/// `next`: per level the first divided block that has not been come to.
void BlockTree::forLeavesIn(const Block& block, int level, std::vector<size_t>& next, Visit visit) const {
  if (size_t(level) < divided.size()) {
    const Blocks& blocks = divided[size_t(level)];
    size_t& at = next[size_t(level)];
    if (at == blocks.size() || blocks[at] != block) return visit(block, level);
    ++at;
  }
  if (level == 0) return;
  for (int32_t child = 0; child < 8; ++child) {
    const Block inside = childOf(block, child);
    if (inGrid(inside, level - 1)) forLeavesIn(inside, level - 1, next, visit);
  }
}

Blocks cutBlocks(const CutMesh& cutMesh) {
  Blocks blocks;
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    const int32_t* cell = &cutMesh.cellGridCell[3 * c];
    const Block block = {cell[0], cell[1], cell[2]};
    if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
  }
  detail::sortUnique(blocks, isBefore);
  return blocks;
}

Blocks cutBlocksByRuns(const CutMesh& cutMesh) {
  const auto nx = int32_t(cutMesh.grid.cells(0)), ny = int32_t(cutMesh.grid.cells(1)), nz = int32_t(cutMesh.grid.cells(2));
  Blocks blocks;
  for (int32_t k = 0; k < nz; ++k) {
    for (int32_t j = 0; j < ny; ++j) {
      const size_t row = size_t(k) * size_t(ny) + size_t(j);
      int32_t next = 0;
      for (uint32_t r = cutMesh.rowRunOffsets[row]; r < cutMesh.rowRunOffsets[row + 1]; ++r) {
        for (; next < cutMesh.runBegin[r]; ++next) blocks.push_back({next, j, k});
        next = cutMesh.runEnd[r];
      }
      for (; next < nx; ++next) blocks.push_back({next, j, k});
    }
  }
  detail::sortUnique(blocks, isBefore);
  return blocks;
}

CoarsenOptions meantFor(const Grid& grid, CoarsenOptions options) {
  if (options.layersPerLevel == CoarsenOptions::kGraded)
    options.layersPerLevel = std::max(1, int(std::max({grid.cells(0), grid.cells(1), grid.cells(2)}) / 12));
  if (options.maxLevel < 0 || options.fineLayers < 0 || options.layersPerLevel < 0)
    throw CallError({Status::badOption, -1, -1, "maxLevel, fineLayers and layersPerLevel can't be negative."});
  return options;
}

}  // namespace mandoline::operators
