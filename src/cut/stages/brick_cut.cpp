#include "cut/stages/brick_cut.h"

#include <memory>

#include "base/sort.h"
#include "cut/stages/harvest.h"

namespace mandoline::detail {
namespace {

/// Cuts bricks one after the other, on one thread.
class BrickThread {
 public:
  BrickThread(const Surface& surface, const SurfaceParts& parts, Bricks& bricks, bool onlyGeneral)
      : surface_(surface), parts_(parts), bricks_(bricks), counted_(countedOf(*surface.input.mesh)), brickSurface_(surface) {
    brickSurface_.onlySweep = gridFaceScratch_.onlyGraph = cellScratch_.onlyGeneral = onlyGeneral;
  }

  /// `memory`: that of all results.
  BrickCut cut(BrickId brick, BrickMemory& memory) {
    cutBrickSurface(surface_, parts_, brick, bricks_, brickSurface_);
    makeStencil(brickSurface_, bricks_, brick, stencil_);
    cutGridEdges(brickSurface_, stencil_, gridEdges_);
    cutGridFaces(brickSurface_, stencil_, gridEdges_, gridFaceScratch_, gridFaces_);
    const CutFaces faces{brickSurface_.triFaces, gridFaces_};
    makeCutCells(brickSurface_, stencil_, faces, cellScratch_, cells_);
    BrickCut result;
    result.vertices = CutVertices::ofBrick(surface_.vertices);
    harvest({brickSurface_, stencil_, gridEdges_, faces, cells_}, counted_, gathered_, memory, result);
    return result;
  }

  void count(Run& run) const {
    run.count(brickSurface_.predicates);
    run.count(gridEdges_.predicates);
    run.count(gridFaceScratch_.predicates);
    run.count(cellScratch_.predicates);
  }

 private:
  const Surface& surface_;
  const SurfaceParts& parts_;
  Bricks& bricks_;
  const std::vector<Counted> counted_;
  BrickSurface brickSurface_;
  Stencil stencil_;
  GridEdges gridEdges_;
  GridFaceScratch gridFaceScratch_;
  GridFaces gridFaces_;
  CellScratch cellScratch_;
  CutCells cells_;
  Gathered gathered_;
};

}  // namespace

BrickCuts cutBricks(const Surface& surface, const SurfaceParts& parts, Bricks& bricks, Run& run, KeptBricks* kept) {
  BrickCuts cuts;
  if (kept) cuts = std::move(kept->cuts);
  cuts.resize(bricks.size());
  const auto weightOf = [&](uint32_t b) { return bricks.parts[{b}].size() + bricks.dividedFaces[{b}].size(); };
  // The heaviest first; but each thread has those that it is given in later loops, too.
  const size_t threads = run.monitor.threads();
  std::vector<uint32_t> order = bricks.here.numbers(unsigned(threads)), ofThread;
  for (size_t thread = 0; thread < threads; ++thread) {
    ofThread.clear();
    for (size_t i = thread; i < order.size(); i += threads) ofThread.push_back(order[i]);
    sortItems(ofThread, [&](uint32_t a, uint32_t b) { return weightOf(a) > weightOf(b); });
    for (size_t i = 0; i < ofThread.size(); ++i) order[thread + i * threads] = ofThread[i];
  }
  std::vector<std::unique_ptr<BrickThread>> cutters(run.monitor.threads());
  std::vector<uint32_t> memory = std::exchange(cuts.freeMemory, {});  // per thread
  while (memory.size() < cutters.size()) {
    memory.push_back(uint32_t(cuts.memory.size()));
    cuts.memory.emplace_back();
  }
  runItems(order, run.monitor, [&](size_t thread, uint32_t b) {
    if (kept && kept->has({b})) return;
    if (!cutters[thread]) cutters[thread] = std::make_unique<BrickThread>(surface, parts, bricks, run.onlyGeneral);
    cuts[{b}] = cutters[thread]->cut({b}, cuts.memory[memory[thread]]);
    cuts[{b}].memory = memory[thread];
  });
  for (const auto& cutter : cutters) {
    if (cutter) cutter->count(run);
  }
  return cuts;
}

}  // namespace mandoline::detail
