#include "mandoline/cut_share.h"

#include "cut/driver.h"
#include "cut/share_summary.h"
#include "cut/stages/input.h"
#include "mesh/run_call.h"

namespace mandoline {

using namespace detail;

namespace {

void requireShare(const ShareOf& shareOf) {
  if (shareOf.index < shareOf.count) return;
  const std::string message = "There is no share " + std::to_string(shareOf.index) + ": there are " + std::to_string(shareOf.count) + ".";
  throw Failure{{Status::badArgument, int64_t(shareOf.index), -1, message}};
}

}  // namespace

struct CutShare::Data {
  Data(PreparedMesh mesh_, Grid grid_, const ShareOf& shareOf_, const RunOptions& options)
      : mesh(std::move(mesh_), grid_, options), grid(std::move(grid_)), shareOf(shareOf_) {
    Monitor monitor(options, kGridStages);
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    state.isNeededAgain = true;
    beginCut(mesh.prepared(), grid, state, clock, run);
    if (shareOf.count > 1) {
      layers.emplace(state.surface.input, workOfLayers(state.surface.input), shareOf.count);
      takeLayers(*layers, shareOf.index, state);
    }
    cutInBricks(state, clock, run);
    state.parts = {};
  }

  CutPart makePartOf(std::span<const std::vector<uint32_t>> summaries, const RunOptions& options) {
    Monitor monitor(options, kGridStages);
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    if (shareOf.count > 1) addSummaries(summaries, {shareOf, *layers, fingerprint()}, state);
    joinBricks(state, clock, run);
    clock.begin("output");
    CutPart part = makePart(mesh.view(), grid, state, run);
    part.exactFallbacks = stats.exactFallbacks;
    return part;
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
    CutMesh cutMesh = makeOutput(std::move(parts), state, run);
    sign(cutMesh, mesh.fingerprint(), mesh.options());
    return cutMesh;
  }
  CutResult common(const std::vector<uint8_t>& hasFace) const {
    if (hasFace.size() != state.surface.input.mesh->triangles.size())
      throw Failure{{Status::badArgument, -1, -1, "hasFace needs one number per triangle."}};
    CutResult result;
    result.stats = stats;
    const RunOptions options;
    Monitor monitor(options, kGridStages);
    Run run{result.stats, monitor};
    result.mesh = makeCommon(hasFace, state, run);
    result.mesh.grid = grid;
    sign(result.mesh, mesh.fingerprint(), mesh.options());
    return result;
  }
  Fingerprint fingerprint() const { return fingerprintOfCut(mesh.fingerprint(), grid, mesh.options()); }

  PreparedForGrid mesh;
  Grid grid;
  ShareOf shareOf;
  CutStats stats;
  std::optional<ShareLayers> layers;  ///< of all shares; none of one alone
  CutState state;
};

CutShare::CutShare(PreparedMesh mesh, Grid grid, const ShareOf& shareOf, const RunOptions& options) {
  runCall("cut", [&] {
    requireShare(shareOf);
    data_ = std::make_shared<Data>(std::move(mesh), std::move(grid), shareOf, options);
  });
}

std::vector<uint32_t> CutShare::summary() const { return summarize(data_->state, data_->shareOf, data_->fingerprint()); }

CutPart CutShare::part(std::span<const std::vector<uint32_t>> summaries, const RunOptions& options) {
  return runCall("cut", [&] { return data_->makePartOf(summaries, options); });
}

std::array<int64_t, 2> CutShare::layers() const {
  const CellLayers& here = data_->state.bricks.grid.here;
  return {here.first, here.past};
}

CutResult CutShare::common(const std::vector<uint8_t>& hasFace) const {
  return runCall("cut", [&] { return data_->common(hasFace); });
}

CutResult CutShare::join(std::vector<CutPart> parts) {
  CutResult result;
  catchErrors(result.error, "cut", [&] { result.mesh = data_->join(std::move(parts)); });
  result.stats = data_->stats;
  return result;
}

}  // namespace mandoline
