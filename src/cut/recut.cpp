#include "mandoline/recut.h"

#include <utility>

#include "base/large_array.h"
#include "cut/driver.h"
#include "cut/stages/input.h"
#include "cut/stages/kept_arrays.h"
#include "cut/stages/kept_bricks.h"
#include "cut/stages/kept_clips.h"
#include "cut/stages/kept_seams.h"
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
    bool isInResult = false;        ///< whether its result is Data::result
    std::vector<double> positions;  ///< of its result, if that is another one; else memory for such
  };

  /// What a cut keeps of one before it.
  class KeepingOf final : public Keeping {
   public:
    /// `positions`: before, unless they are in `now.spare`. `arrays`: null unless the result is to be written over that before.
    KeepingOf(CutState& before, std::vector<double>& positions, KeptArrays* arrays, CutState& now, const Moved& moved)
        : before_(before), positions_(positions), arrays_(arrays), now_(now), moved_(moved), slabs_{before_.surface.input, moved} {}

    const KnownSlabs* slabs() override { return &slabs_; }
    const KnownCrossings& crossings() override { return crossings_.emplace(before_.surface, now_.surface, moved_); }
    KnownClips& clips() override {
      map_.emplace(*crossings_, now_.surface, moved_);
      return clips_.emplace(before_.surface, before_.parts.clipped, *map_);
    }
    KeptBricks& bricks() override {
      kept_ = keepBricks({before_.surface, before_.parts, before_.bricks, before_.cuts}, std::move(*map_), now_.surface, now_.parts,
                         now_.bricks);
      return kept_;
    }
    IdVector<BrickId, BrickSeams> seams() override { return keepSeams(kept_, now_.runs, before_.seams); }
    KeptArrays* arrays() override { return kept_.before.empty() || doTrianglesMeet(before_) || doTrianglesMeet(now_) ? nullptr : arrays_; }
    KeptVertices vertices() override {
      if (kept_.before.empty()) return {};
      const VerticesBefore before{before_.bricks, before_.seams, before_.numbers};
      KeptVertices kept{findKeptVertices(before, kept_, now_.cut(), now_.numbers), {}, arrays() != nullptr};
      if (kept.areInPlace) {
        arrays_->begin(before, now_, kept);
      } else {
        if (arrays_) positions_.swap(now_.spare.positions);
        kept.positions = positions_;
      }
      return kept;
    }
    size_t brickCount() const {
      size_t count = 0;
      for (const BrickId b : kept_.before.ids()) count += kept_.has(b);
      return count;
    }

   private:
    /// Then vertices that they make have other parents.
    static bool doTrianglesMeet(const CutState& state) { return state.surface.input.mesh->hasIntersections(); }

    CutState& before_;
    std::vector<double>& positions_;
    KeptArrays* const arrays_;
    CutState& now_;
    const Moved& moved_;
    const KnownSlabs slabs_;
    std::optional<CrossingsBefore> crossings_;
    std::optional<SurfaceMap> map_;
    std::optional<ClipsBefore> clips_;
    KeptBricks kept_;
  };

  Grid grid;
  CutOptions options;
  LastCut last;      ///< empty after an error
  CutResult result;  ///< that of recut()
  Counts counts;

  /// `own`: null unless this becomes `result`, of which `spare` is the mesh.
  CutMesh cut(const MeshView& mesh, CutMesh spare, CutStats& stats, KeptArrays* own) {
    Monitor monitor(options, kMeshStages + kGridStages);
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    LastCut before = std::exchange(last, {});
    checkGrid(grid, options.snapTolerance);
    const SnappedInput input(mesh, grid, options, stats);
    LastCut now{nullptr, std::make_unique<CutState>(), own != nullptr, {}};
    CutState& state = *now.state;
    state.isNeededAgain = true;
    state.spare = std::move(spare);
    std::vector<double>& positions = before.isInResult && !own ? result.mesh.positions : before.positions;
    const auto beginStage = [&](const char* stage) { clock.begin(stage); };
    const Preparation preparation{largestCoordinate(grid), options.intersections, true};
    PreparedAgain again;
    std::optional<KeepingOf> keeping;
    if (before.state) {
      again = prepareAgain(input.view(), preparation, *before.prepared, monitor, beginStage);
      if (!again.moved.empty()) keeping.emplace(*before.state, positions, before.isInResult ? own : nullptr, state, again.moved);
    } else {
      again.mesh = prepareMesh(input.view(), preparation, monitor, beginStage);
    }
    now.prepared = std::move(again.mesh);
    state.keeping = keeping ? &*keeping : nullptr;
    beginCut(*now.prepared, grid, state, clock, run);
    state.brickShifts = keeping ? before.state->bricks.grid.shifts : BrickGrid::shiftsForMoving(state.surface.input);
    CutMesh cutMesh = cutPrepared(state, input.view(), grid, clock, run);
    sign(cutMesh, fingerprintOf(mesh), options);
    counts = {state.bricks.size(), keeping ? keeping->brickCount() : 0};
    now.positions = std::move(before.positions);
    if (!own) {
      now.positions.clear();
      copyLarge(cutMesh.positions, now.positions);
    }
    state.numbers.faces = {};
    state.numbers.ofBrick = {};
    state.keeping = nullptr;
    state.kept = nullptr;
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
  catchErrors(result.error, "cut", [&] { result.mesh = data_->cut(mesh, std::move(spare), result.stats, nullptr); });
  return result;
}

const CutResult& Recutter::recut(const MeshView& mesh) {
  CutMesh before = std::move(data_->result.mesh);
  CutResult& result = data_->result = {};
  ArraysBefore arrays;
  catchErrors(result.error, "cut", [&] { result.mesh = data_->cut(mesh, std::move(before), result.stats, &arrays); });
  return result;
}

Recutter::Counts Recutter::counts() const { return data_->counts; }

}  // namespace mandoline
