#include "mandoline/coarsen.h"

#include <algorithm>

#include "base/function_ref.h"
#include "base/large_array.h"
#include "base/sort.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "operators/coarsen/morton_order.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

/// A block of grid cells of some level: its lowest grid cell, divided by the block's size.
using Block = std::array<int32_t, 3>;
using operators::isBefore;
using Blocks = std::vector<Block>;  // ascending along the Morton curve, each once

constexpr const char* kIncomplete = "The cut-mesh is not valid: it has neither cut-cells nor a run for a grid cell.";

class Coarsener {
 public:
  Coarsener(const CutMesh& cutMesh, const CoarsenOptions& options, detail::Monitor& monitor)
      : untouched_(cutMesh), options_(options), monitor_(monitor) {
    for (int d = 0; d < 3; ++d) result_.gridCells[size_t(d)] = int32_t(cutMesh.grid.cells(d));
    for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
      const int32_t* cell = &cutMesh.cellGridCell[3 * c];
      const Block block = {cell[0], cell[1], cell[2]};
      if (cut_.empty() || cut_.back() != block) cut_.push_back(block);
    }
    detail::sortUnique(cut_, isBefore);
  }

  OctreeCells run() {
    int top = 0;  // the level of a block that holds the grid
    while (!holdsGrid(top)) ++top;
    options_.maxLevel = std::min(options_.maxLevel, top);
    monitor_.beginStage("levels", 0);
    findDivided();
    const size_t count = countCells(top);
    monitor_.beginStage("cells", 1);
    detail::reserveLarge(result_.cellCorner, 3 * count);
    detail::reserveLarge(result_.cellLevel, count);
    detail::reserveLarge(result_.cellRegion, count);
    forCells(top, [&](const Block& block, int level) { addCell(block, level); });
    return std::move(result_);
  }

 private:
  bool inGrid(const Block& block, int level) const {
    bool inside = true;
    for (size_t d = 0; d < 3; ++d) inside &= block[d] >= 0 && int64_t(block[d]) << level < result_.gridCells[d];
    return inside;
  }
  bool holdsGrid(int level) const { return !inGrid({1, 0, 0}, level) && !inGrid({0, 1, 0}, level) && !inGrid({0, 0, 1}, level); }

  /// Fills divided_: the blocks of each level that have smaller ones inside.
  void findDivided() {
    divided_.resize(size_t(options_.maxLevel) + 1);
    if (options_.maxLevel == 0) return;
    divided_[1] = parentsAround(cut_, 1, options_.fineLayers);
    for (int level = 2; level <= options_.maxLevel; ++level) {
      monitor_.report(size_t(level), size_t(options_.maxLevel));
      const Blocks& inside = divided_[size_t(level) - 1];
      if (options_.layersPerLevel > 0) divided_[size_t(level)] = parentsAround(inside, level, options_.layersPerLevel);
      for (const Block& block : inside) addParents(block, level);
      detail::sortUnique(divided_[size_t(level)], isBefore);
    }
  }

  /// Divides the parent of a divided block, and those of its neighbours, which must not be larger than it: along each axis one neighbour
  /// has another parent.
  void addParents(const Block& block, int level) {
    const Block parent = {block[0] >> 1, block[1] >> 1, block[2] >> 1};
    for (int axes = 0; axes < 7; ++axes) {  // the set of axes along which to step
      const bool isFace = (axes & (axes - 1)) == 0;
      if (!isFace && !options_.balanceEdges) continue;
      Block neighbour = parent;
      for (size_t d = 0; d < 3; ++d) {
        if (axes >> d & 1) neighbour[d] += block[d] % 2 == 0 ? -1 : 1;
      }
      if (inGrid(neighbour, level)) divided_[size_t(level)].push_back(neighbour);
    }
  }

  /// The blocks of a level with blocks of the level below that are among these or in a layer around one.
  Blocks parentsAround(Blocks blocks, int level, int32_t layers) const {
    for (size_t d = 0; d < 3; ++d) {  // numbers of blocks become numbers of parents, axis by axis
      const int32_t end = (result_.gridCells[d] - 1) >> (level - 1);
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

  using Visit = detail::FunctionRef<void(const Block&, int)>;

  /// Calls visit(block, level) for all cells, in Morton order, in which all lists of blocks are.
  void forCells(int top, Visit visit) {
    next_.assign(size_t(options_.maxLevel) + 1, 0);
    forCellsIn({0, 0, 0}, top, visit);
  }

  void forCellsIn(const Block& block, int level, Visit visit) {
    if (level <= options_.maxLevel) {
      const Blocks& divided = level == 0 ? cut_ : divided_[size_t(level)];
      size_t& next = next_[size_t(level)];
      if (next == divided.size() || divided[next] != block) return visit(block, level);
      ++next;
    }
    if (level == 0) return;
    for (int32_t child = 0; child < 8; ++child) {
      const Block inside = {2 * block[0] + (child & 1), 2 * block[1] + (child >> 1 & 1), 2 * block[2] + (child >> 2)};
      if (inGrid(inside, level - 1)) forCellsIn(inside, level - 1, visit);
    }
  }

  size_t countCells(int top) {
    const uint64_t untouched = untouched_.count();
    size_t count = 0;
    forCells(top, [&](const Block&, int) {
      if (++count > untouched) operators::refuse(kIncomplete);  // before there is no end of them
      if (count % 4096 == 0) monitor_.report(1, 1);
    });
    return count;
  }

  void addCell(const Block& block, int level) {
    if (result_.cellCount() % 4096 == 0) monitor_.report(next_[0], cut_.size());
    const Block corner = {block[0] << level, block[1] << level, block[2] << level};
    const int64_t region = untouched_.regionAt(corner[0], corner[1], corner[2]);
    if (region < 0) operators::refuse(kIncomplete);
    result_.cellCorner.insert(result_.cellCorner.end(), corner.begin(), corner.end());
    result_.cellLevel.push_back(uint8_t(level));
    result_.cellRegion.push_back(uint32_t(region));
  }

  UntouchedCells untouched_;
  CoarsenOptions options_;
  detail::Monitor& monitor_;
  Blocks cut_;
  std::vector<Blocks> divided_;  // per level
  std::vector<size_t> next_;     // per level: the first block of divided_ (of cut_ at level 0) that forCells() has not come to
  OctreeCells result_;
};

}  // namespace

int64_t OctreeCells::find(int64_t i, int64_t j, int64_t k) const {
  if (i < 0 || j < 0 || k < 0 || i >= gridCells[0] || j >= gridCells[1] || k >= gridCells[2]) return -1;
  const Block at = {int32_t(i), int32_t(j), int32_t(k)};
  size_t first = 0, past = cellCount();  // the cells that may be the last one not after it
  while (first < past) {
    const size_t middle = first + (past - first) / 2;
    if (isBefore(at, corner(middle))) {
      past = middle;
    } else {
      first = middle + 1;
    }
  }
  if (first == 0) return -1;
  const auto last = end(first - 1), begin = corner(first - 1);
  for (size_t d = 0; d < 3; ++d) {
    if (at[d] < begin[d] || at[d] >= last[d]) return -1;
  }
  return int64_t(first) - 1;
}

OctreeCells coarsen(const CutMesh& cutMesh, const CoarsenOptions& options) {
  operators::requireCutMesh(cutMesh);
  CoarsenOptions meant = options;
  if (options.layersPerLevel == CoarsenOptions::kGraded) {
    const auto [x, y, z] = std::array{cutMesh.grid.cells(0), cutMesh.grid.cells(1), cutMesh.grid.cells(2)};
    meant.layersPerLevel = std::max(1, int(std::max({x, y, z}) / 32));
  }
  if (meant.maxLevel < 0 || meant.fineLayers < 0 || meant.layersPerLevel < 0) {
    throw CallError({Status::badOption, -1, -1, "maxLevel, fineLayers and layersPerLevel can't be negative."});
  }
  return detail::runCall("coarsening", [&] {
    detail::Monitor monitor(options, 2);
    OctreeCells result = Coarsener(cutMesh, meant, monitor).run();
    detail::Fingerprinter fingerprinter("octree", cutMesh.fingerprint);
    for (const int option : {meant.maxLevel, meant.fineLayers, meant.layersPerLevel, int(meant.balanceEdges)})
      fingerprinter.add(uint64_t(option));
    result.madeFrom = cutMesh.fingerprint;
    result.fingerprint = fingerprinter.get();
    return result;
  });
}

}  // namespace mandoline
