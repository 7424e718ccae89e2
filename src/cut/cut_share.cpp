#include "mandoline/cut_share.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "base/large_array.h"
#include "cut/driver.h"
#include "cut/share_summary.h"
#include "cut/stages/input.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"

namespace mandoline {

using namespace detail;

namespace {

void requireShare(const ShareOf& shareOf) {
  if (shareOf.index < shareOf.count) return;
  const std::string message = "There is no share " + std::to_string(shareOf.index) + ": there are " + std::to_string(shareOf.count) + ".";
  throw Failure{{Status::badArgument, int64_t(shareOf.index), -1, message}};
}

/// How much more work the first share may have than others, which wait for nobody: it waits for their parts, and these take this fraction
/// of a share to be copied and sent, as measured for workers of a page.
constexpr uint64_t kSending = 20;
void leaveToFirst(std::vector<uint64_t>& work, uint32_t count) {
  uint64_t left = std::accumulate(work.begin(), work.end(), uint64_t(0)) / count / kSending;
  for (uint64_t& ofLayer : work) {
    const uint64_t less = std::min(ofLayer, left);
    ofLayer -= less;
    left -= less;
  }
}

}  // namespace

struct CutShare::Data {
  Data(PreparedMesh mesh_, Grid grid_, const ShareOf& shareOf_, const RunOptions& options, TakeExcerpt* takeExcerpt)
      : mesh(std::in_place, std::move(mesh_), grid_, options),
        grid(std::move(grid_)),
        shareOf(shareOf_),
        madeFrom(mesh->fingerprint()),
        cutOptions(mesh->options()) {
    Monitor monitor(options, kGridStages);
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    state->isNeededAgain = !takeExcerpt;
    beginCut(mesh->prepared(), grid, *state, clock, run);
    if (shareOf.count > 1) takeShare(takeExcerpt);
    cutHere(clock, run);
  }

  Data(std::unique_ptr<ShareInput> input, Grid grid_, const ShareOf& shareOf_, const RunOptions& options)
      : grid(std::move(grid_)), shareOf(shareOf_), madeFrom(input->fingerprint), stats(std::move(input->stats)), layers(input->layers) {
    cutOptions.intersections = input->intersections;
    Monitor monitor(options, kGridStages);
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    clock.begin("grid");
    takeLayers();
    excerpt = takeInputExcerpt(*input, *state);
    input.reset();
    cutHere(clock, run);
  }

  void cutHere(Clock& clock, Run& run) {
    nameByWhole([&] { cutInBricks(*state, clock, run); });
    state->parts = {};
    if (!state->isNeededAgain) giveBackFreed();
  }

  void takeLayers() {
    state->brickShifts = layers->shifts();
    state->layersHere = layers->of(shareOf.index);
    state->shareBorders = layers->borders();
  }

  void takeShare(TakeExcerpt* takeExcerpt) {
    const Input& input = state->surface.input;
    constexpr size_t kEnough = 1 << 14;  // triangles that show where the work is: workers share cuts of some 100 ms, where each counts
    const size_t every = takeExcerpt ? 1 : input.mesh->triangles.size() / kEnough + 1;
    std::vector<uint64_t> work = workOfLayers(input, uint32_t(every));
    if (!takeExcerpt) leaveToFirst(work, shareOf.count);
    layers.emplace(input, work, shareOf.count);
    takeLayers();
    if (!takeExcerpt) return takeSurface(*state);
    excerpt = takeExcerpt(mesh->view(), *state);
    mesh.reset();
    giveBackFreed();
  }

  /// What fails names triangles of the whole mesh.
  template <class Body>
  void nameByWhole(const Body& body) {
    try {
      body();
    } catch (Failure& failure) {
      Error& error = failure.error;
      if (excerpt) excerpt->nameByWhole(error);
      if (error.status == Status::selfIntersection && error.message.empty()) {  // no share has all triangles, to look for two that meet
        error.message = "Triangles meet other than in shared vertices and edges";
        if (error.element >= 0) error.message += ", at triangle " + std::to_string(error.element) + " or near it";
        error.message += "; a cut in one process names two.";
      }
      throw;
    }
  }

  CutPart makePartOf(std::span<const std::vector<uint32_t>> summaries, const RunOptions& options) {
    if (!mesh && !excerpt) throw CallError({Status::badArgument, -1, -1, "This share has given its part."});
    Monitor monitor(options, kGridStages);
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    if (shareOf.count > 1) addSummaries(summaries, context(), *layers, *state);
    nameByWhole([&] { joinBricks(*state, clock, run); });
    clock.begin("output");
    CutPart part = makePart(excerpt ? MeshView(excerpt->positions, {}) : mesh->view(), grid, *state, run);
    part.exactFallbacks = stats.exactFallbacks;
    if (excerpt) excerpt->nameByWhole(part.cutMesh);
    if (!state->isNeededAgain) keepCommon();
    return part;
  }

  /// Frees all but what common() and join() need.
  void keepCommon() {
    auto rest = std::make_unique<CutState>();
    rest->bricks.grid = state->bricks.grid;
    rest->runs = std::move(state->runs);
    rest->regions = std::move(state->regions);
    rest->wholeTriangles = excerpt ? std::move(state->wholeTriangles) : WholeTriangles(mesh->prepared());
    state = std::move(rest);
    excerpt.reset();
    mesh.reset();
    giveBackFreed();
  }
  CutMesh join(std::vector<CutPart> parts) {
    if (shareOf.index != 0 || parts.size() != shareOf.count)
      throw Failure{{Status::badArgument, -1, -1, "The first share is joined, with one part of each."}};
    const RunOptions options;
    Monitor monitor(options, kGridStages);
    Clock clock(stats, monitor);
    clock.resume();
    Run run{stats, monitor};
    stats.exactFallbacks = 0;
    for (const CutPart& part : parts) stats.exactFallbacks += part.exactFallbacks;
    CutMesh cutMesh = makeOutput(std::move(parts), *state, run);
    sign(cutMesh, madeFrom, cutOptions);
    return cutMesh;
  }
  CutResult common(const std::vector<uint8_t>& hasFace) const {
    if (hasFace.size() != (state->wholeTriangles ? state->wholeTriangles->count : state->surface.input.mesh->triangles.size()))
      throw Failure{{Status::badArgument, -1, -1, "hasFace needs one number per triangle."}};
    CutResult result;
    result.stats = stats;
    const RunOptions options;
    Monitor monitor(options, kGridStages);
    Run run{result.stats, monitor};
    result.mesh = makeCommon(hasFace, *state, run);
    result.mesh.grid = grid;
    sign(result.mesh, madeFrom, cutOptions);
    return result;
  }
  std::vector<int32_t> gridCellRegion() const {
    if (state->regions.runRegion.size() != state->runs.begin.size() || state->runs.rowOffsets.empty())
      throw CallError({Status::badArgument, -1, -1, "The regions are known from part() on, until join()."});
    CutMesh runs;
    runs.grid = grid;
    runs.rowRunOffsets = state->runs.rowOffsets;
    runs.runBegin = state->runs.begin;
    runs.runEnd = state->runs.end;
    runs.runRegion = state->regions.runRegion;
    return runs.gridCellRegion();
  }
  /// Shares of a cut have the same borders.
  ShareContext context() const {
    Fingerprinter fingerprinter("share", fingerprintOfCut(madeFrom, grid, cutOptions));
    for (const int32_t border : state->shareBorders) fingerprinter.add(uint64_t(border));
    return {shareOf, fingerprinter.get(), excerpt.get()};
  }

  std::optional<PreparedForGrid> mesh;    ///< unless there is an excerpt
  std::unique_ptr<ShareExcerpt> excerpt;  ///< of the mesh, if the share has no more of it
  Grid grid;
  ShareOf shareOf;
  Fingerprint madeFrom;
  CutOptions cutOptions;
  CutStats stats;
  std::optional<ShareLayers> layers;  ///< of all shares; none of one alone
  std::unique_ptr<CutState> state = std::make_unique<CutState>();
};

CutShare::CutShare(PreparedMesh mesh, Grid grid, const ShareOf& shareOf, const RunOptions& options, TakeExcerpt* takeExcerpt) {
  runCall("cut", [&] {
    requireShare(shareOf);
    data_ = std::make_shared<Data>(std::move(mesh), std::move(grid), shareOf, options, takeExcerpt);
  });
}

CutShare::CutShare(std::unique_ptr<ShareInput> input, Grid grid, const ShareOf& shareOf, const RunOptions& options) {
  runCall("cut", [&] { data_ = std::make_shared<Data>(std::move(input), std::move(grid), shareOf, options); });
}

std::vector<uint32_t> CutShare::summary() const { return summarize(*data_->state, data_->context()); }

CutPart CutShare::part(std::span<const std::vector<uint32_t>> summaries, const RunOptions& options) {
  return runCall("cut", [&] { return data_->makePartOf(summaries, options); });
}

std::array<int64_t, 2> CutShare::layers() const {
  const CellLayers& here = data_->state->bricks.grid.here;
  return {here.first, here.past};
}

CutResult CutShare::common(const std::vector<uint8_t>& hasFace) const {
  return runCall("cut", [&] { return data_->common(hasFace); });
}

std::vector<int32_t> CutShare::gridCellRegion() const { return data_->gridCellRegion(); }

CutResult CutShare::join(std::vector<CutPart> parts) {
  CutResult result;
  catchErrors(result.error, "cut", [&] { result.mesh = data_->join(std::move(parts)); });
  result.stats = data_->stats;
  return result;
}

}  // namespace mandoline
