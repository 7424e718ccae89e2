#include "mandoline/recut.h"

#include <algorithm>
#include <utility>

#include "cut/driver.h"
#include "cut/stages/input.h"
#include "cut/stages/kept_bricks.h"
#include "mesh/fingerprints.h"
#include "mesh/prepare_again.h"
#include "mesh/run_call.h"

namespace mandoline {

using namespace detail;

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
    state.spare = std::move(spare);
    const auto beginStage = [&](const char* stage) { clock.begin(stage); };
    const Preparation preparation{largestCoordinate(grid), options.intersections, true};
    Counts found;
    Moved moved;
    if (before.state) {
      PreparedAgain again = prepareAgain(input.view(), preparation, *before.prepared, monitor, beginStage);
      now.prepared = std::move(again.mesh);
      moved = std::move(again.moved);
    } else {
      now.prepared = prepareMesh(input.view(), preparation, monitor, beginStage);
    }
    beginCut(*now.prepared, grid, state, clock, run);
    state.brickShifts = moved.empty() ? BrickGrid::shiftsForMoving(state.surface.input) : before.state->bricks.grid.shifts;
    if (!moved.empty()) {
      state.keepBricks = [&] {
        CutState& cut = *before.state;
        KeptBricks kept = keepBricks({cut.surface, cut.parts, cut.bricks, cut.cuts, moved}, state.surface, state.parts, state.bricks);
        found.kept = size_t(std::count(kept.isKept.begin(), kept.isKept.end(), 1));
        return kept;
      };
    }
    CutMesh cutMesh = cutPrepared(state, input.view(), grid, clock, run);
    sign(cutMesh, fingerprintOf(mesh), options);
    found.bricks = state.bricks.size();
    counts = found;
    state.keepBricks = nullptr;
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
