#include "mandoline/coarsen.h"

#include <algorithm>

#include "base/large_array.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "operators/coarsen/block_tree.h"
#include "operators/coarsen/coarsen_runs.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using operators::Block;
using operators::isBefore;

constexpr const char* kIncomplete = "The cut-mesh is not valid: it has neither cut-cells nor a run for a grid cell.";

class Coarsener {
 public:
  /// `cut`: the grid cells that have cut-cells.
  Coarsener(const CutMesh& cutMesh, operators::Blocks cut, const CoarsenOptions& options, detail::Monitor& monitor)
      : untouched_(cutMesh), options_(options), monitor_(monitor), cut_(std::move(cut)) {
    for (int d = 0; d < 3; ++d) result_.gridCells[size_t(d)] = int32_t(cutMesh.grid.cells(d));
  }

  OctreeCells run() {
    monitor_.beginStage("levels", 0);
    tree_.gridCells = result_.gridCells;
    tree_.divided.resize(size_t(std::min(options_.maxLevel, tree_.top())) + 1);
    tree_.divideAbove(0, cut_, options_, monitor_);
    tree_.divided[0] = std::move(cut_);
    const size_t count = countCells();
    monitor_.beginStage("cells", 1);
    detail::reserveLarge(result_.cellCorner, 3 * count);
    detail::reserveLarge(result_.cellLevel, count);
    detail::reserveLarge(result_.cellRegion, count);
    tree_.forLeaves([&](const Block& block, int level) {
      if (result_.cellCount() % 4096 == 0) monitor_.report(result_.cellCount(), count);
      addCell(block, level);
    });
    return std::move(result_);
  }

 private:
  size_t countCells() {
    const uint64_t untouched = untouched_.count();
    size_t count = 0;
    tree_.forLeaves([&](const Block&, int) {
      if (++count > untouched) operators::refuse(kIncomplete);  // before there is no end of them
      if (count % 4096 == 0) monitor_.report(1, 1);
    });
    return count;
  }

  void addCell(const Block& block, int level) {
    const Block corner = {block[0] << level, block[1] << level, block[2] << level};
    const int64_t region = untouched_.regionAt(corner[0], corner[1], corner[2]);
    if (region < 0) operators::refuse(kIncomplete);
    result_.cellCorner.insert(result_.cellCorner.end(), corner.begin(), corner.end());
    result_.cellLevel.push_back(uint8_t(level));
    result_.cellRegion.push_back(uint32_t(region));
  }

  UntouchedCells untouched_;
  const CoarsenOptions& options_;
  detail::Monitor& monitor_;
  operators::Blocks cut_;
  operators::BlockTree tree_;
  OctreeCells result_;
};

OctreeCells coarsenAround(const CutMesh& cutMesh, operators::Blocks (*cutBlocks)(const CutMesh&), const CoarsenOptions& options) {
  const CoarsenOptions meant = operators::meantFor(cutMesh.grid, options);
  return detail::runCall("coarsening", [&] {
    detail::Monitor monitor(options, 2);
    OctreeCells result = Coarsener(cutMesh, cutBlocks(cutMesh), meant, monitor).run();
    detail::Fingerprinter fingerprinter("octree", cutMesh.fingerprint);
    for (const int option : {meant.maxLevel, meant.fineLayers, meant.layersPerLevel, int(meant.balanceEdges)})
      fingerprinter.add(uint64_t(option));
    result.madeFrom = cutMesh.fingerprint;
    result.fingerprint = fingerprinter.get();
    return result;
  });
}

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
  return coarsenAround(cutMesh, operators::cutBlocks, options);
}

OctreeCells operators::coarsenRuns(const CutMesh& cutMesh, const CoarsenOptions& options) {
  return coarsenAround(cutMesh, cutBlocksByRuns, options);
}

}  // namespace mandoline
