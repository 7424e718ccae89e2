#include "mandoline/recut.h"

#include <utility>

#include "base/large_array.h"
#include "cut/driver.h"
#include "cut/stages/input.h"
#include "cut/stages/kept_bricks.h"
#include "cut/stages/kept_seams.h"
#include "mesh/fingerprints.h"
#include "mesh/prepare_again.h"
#include "mesh/run_call.h"

namespace mandoline {

using namespace detail;

/// What a cut keeps of one before it.
static Keeping keepingOf(CutState& before, CutState& now) {
  Keeping keeping;
  keeping.bricks = [&] {
    return keepBricks({before.surface, before.parts, before.bricks, before.cuts, now.moved}, now.surface, now.parts, now.bricks);
  };
  keeping.seams = [&] { return keepSeams(now.kept, now.runs, before.seams); };
  keeping.vertices = [&] {
    if (now.kept.before.empty()) return KeptVertices();
    return KeptVertices{findKeptVertices(now.cut(), now.kept, before.numbers, now.numbers), before.positions};
  };
  return keeping;
}

struct Recutter::Data {
  /// All of a cut, for the next one.
  struct LastCut {
    std::unique_ptr<Prepared> prepared;
    std::unique_ptr<CutState> state;
  };

  Grid grid;
  CutOptions options;
  LastCut last;  ///< empty after an error
  Counts counts;

  CutMesh cut(const MeshView& mesh, CutMesh spare, CutStats& stats) {
    Monitor monitor(options, kMeshStages + kGridStages);
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    LastCut before = std::exchange(last, {});
    checkGrid(grid, options.snapTolerance);
    const SnappedInput input(mesh, grid, options, stats);
    LastCut now{nullptr, std::make_unique<CutState>()};
    CutState& state = *now.state;
    state.isNeededAgain = true;
    state.spare = std::move(spare);
    const auto beginStage = [&](const char* stage) { clock.begin(stage); };
    const Preparation preparation{largestCoordinate(grid), options.intersections, true};
    if (before.state) {
      PreparedAgain again = prepareAgain(input.view(), preparation, *before.prepared, monitor, beginStage);
      now.prepared = std::move(again.mesh);
      if (!again.moved.empty()) state.before = before.state.get();
      state.moved = std::move(again.moved);
    } else {
      now.prepared = prepareMesh(input.view(), preparation, monitor, beginStage);
    }
    beginCut(*now.prepared, grid, state, clock, run);
    state.brickShifts = state.before ? state.before->bricks.grid.shifts : BrickGrid::shiftsForMoving(state.surface.input);
    if (state.before) state.keeping = keepingOf(*state.before, state);
    CutMesh cutMesh = cutPrepared(state, input.view(), grid, clock, run);
    sign(cutMesh, fingerprintOf(mesh), options);
    counts = {state.bricks.size(), 0};
    for (const BrickId b : state.bricks.ids()) counts.kept += state.kept.has(b);
    if (state.before) state.positions = std::move(state.before->positions);
    state.positions.clear();
    copyLarge(cutMesh.positions, state.positions);
    state.before = nullptr;
    state.keeping = {};
    state.kept = {};
    last = std::move(now);
    return cutMesh;
  }
};

Recutter::Recutter(Grid grid, const CutOptions& options) : data_(std::make_unique<Data>()) {
  data_->grid = std::move(grid);
  data_->options = options;
}
Recutter::Recutter(Recutter&&) noexcept = default;
Recutter& Recutter::operator=(Recutter&&) noexcept = default;
Recutter::~Recutter() = default;

CutResult Recutter::cut(const MeshView& mesh, CutMesh spare) {
  CutResult result;
  catchErrors(result.error, "cut", [&] { result.mesh = data_->cut(mesh, std::move(spare), result.stats); });
  return result;
}

Recutter::Counts Recutter::counts() const { return data_->counts; }

}  // namespace mandoline
