// The driver: Algorithm 1 of the paper, bottom-up. Each stage has its own header, which is its contract.
#include "base/milliseconds.h"
#include "cut/contradiction.h"
#include "cut/driver.h"
#include "cut/stages/divided_faces.h"
#include "cut/stages/input.h"
#include "mandoline/orient.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"

namespace mandoline {

namespace detail {

constexpr int kOrientStages = 2;

void addCounts(const Prepared& prepared, CutStats& stats) {
  stats.weldedVertices = prepared.counts.weldedVertices;
  stats.zeroAreaTriangles = prepared.counts.zeroAreaTriangles;
  stats.duplicateTriangles = uint32_t(prepared.duplicates.size());
  stats.flushedCoordinates += prepared.counts.flushedCoordinates;
  stats.parts = prepared.parts.counts;
  stats.exactFallbacks += prepared.counts.exactFallbacks;
  if (!prepared.arrangement) return;
  stats.intersections = prepared.arrangement->pairs;
  if (prepared.arrangement->empty()) return;
  stats.intersectionCurves = prepared.arrangement->curves;
}

Clock::Clock(CutStats& stats, Monitor& monitor, int before)
    : stats_(stats), monitor_(monitor), before_(before), start_(milliseconds() - stats.totalMs), last_(milliseconds()) {}

void Clock::begin(const char* stage) {
  end();
  isInStage_ = false;  // should there be no memory for the next
  stats_.stages.push_back({stage, 0});
  isInStage_ = true;
  monitor_.beginStage(stage, before_ + int(stats_.stages.size()) - 1);
}

void Clock::resume() {
  isInStage_ = true;
  last_ -= stats_.stages.back().ms;
}

void Clock::end() {
  const double t = milliseconds();
  if (isInStage_) stats_.stages.back().ms = t - last_;
  stats_.totalMs = t - start_;
  last_ = t;
}

int stagesBefore(const PrepareOptions& options) { return options.orient ? kOrientStages : 0; }

std::shared_ptr<PreparedMeshData> beginPreparing(const MeshToPrepare& mesh, const PrepareOptions& options, Monitor& monitor) {
  auto data = std::make_shared<PreparedMeshData>();
  const auto& [positions, triangles] = mesh.view;
  if (options.orient) {
    data->mesh = std::make_shared<Mesh>(orient(mesh.view, monitor.part<RunOptions>(0, kMeshStages)).mesh);
  } else if (mesh.shared) {
    data->mesh = mesh.shared;
  } else {
    data->mesh = std::make_shared<Mesh>(Mesh{{positions.begin(), positions.end()}, {triangles.begin(), triangles.end()}});
  }
  data->fingerprint = fingerprintOf(*data->mesh);
  data->intersections = options.intersections;
  return data;
}

void finishPreparing(std::shared_ptr<PreparedMeshData> data, std::unique_ptr<Prepared> prepared, PrepareResult& result) {
  addCounts(*prepared, result.stats);
  data->prepared = std::move(prepared);
  result.mesh = PreparedMesh(std::move(data));
}

PrepareResult prepareThis(const MeshToPrepare& mesh, const PrepareOptions& options) {
  PrepareResult result;
  catchErrors(result.error, "preparation", [&] {
    Monitor monitor(options, stagesBefore(options) + kMeshStages);
    std::shared_ptr<PreparedMeshData> data = beginPreparing(mesh, options, monitor);
    Clock clock(result.stats, monitor, stagesBefore(options));
    auto prepared = prepareMesh(*data->mesh, {0, options.intersections}, monitor, [&](const char* stage) { clock.begin(stage); });
    finishPreparing(std::move(data), std::move(prepared), result);
  });
  return result;
}

bool fits(int shift, const Grid& grid) {
  const double largest = largestCoordinate(grid);
  return largest == 0 || std::ilogb(largest) + shift <= Scale::kLargestExponent + Scale::kRoom;
}

PreparedForGrid::PreparedForGrid(PreparedMesh mesh, const Grid& grid, const RunOptions& options) : mesh_(std::move(mesh)) {
  checkGrid(grid, 0);
  const PreparedMeshData* data = mesh_.data();
  if (data && fits(data->prepared->shift, grid)) return;
  Monitor monitor(options, 1);
  again_ = prepareMesh(view(), {largestCoordinate(grid), this->options().intersections}, monitor, [](const char*) {});
}

Fingerprint PreparedForGrid::fingerprint() const { return mesh_.data() ? mesh_.data()->fingerprint : Fingerprint{}; }

CutOptions PreparedForGrid::options() const {
  CutOptions options;
  if (mesh_.data()) options.intersections = mesh_.data()->intersections;
  return options;
}

void beginCut(const Prepared& prepared, const Grid& grid, CutState& state, Clock& clock, Run& run) {
  addCounts(prepared, run.stats);
  clock.begin("grid");
  state.surface.input = prepareInput(prepared, grid, run, state.keeping ? state.keeping->slabs() : nullptr);
}

SnappedInput::SnappedInput(const MeshView& mesh, const Grid& grid, const CutOptions& options, CutStats& stats) : view_(mesh) {
  if (options.snapTolerance == 0) return;
  moved_ = snapped(mesh, grid, options.snapTolerance);
  stats.snappedVertices = moved_.vertices;
  stats.largestSnap = moved_.largest;
  view_ = moved_.mesh;
}

void cutInBricks(CutState& state, Clock& clock, Run& run) {
  clock.begin("triEdges");
  cutTriEdges(state.surface, run, state.keeping ? &state.keeping->crossings() : nullptr);
  cutBricksHere(state, clock, run);
}

void cutBricksHere(CutState& state, Clock& clock, Run& run) {
  Surface& surface = state.surface;
  const Input& input = surface.input;

  clock.begin("triFaces");
  const std::array<int, 3> shifts = state.brickShifts ? *state.brickShifts : BrickGrid::shiftsFor(input, run.monitor.threads());
  BrickGrid brickGrid(input, shifts, state.shareBorders);
  if (state.layersHere) brickGrid.here = *state.layersHere;
  state.parts.clipped = clipTriangles(surface, brickGrid, run, state.keeping ? &state.keeping->clips() : nullptr);
  divideFaces(surface, state.parts.clipped.undivided, state.parts.divided, run);

  clock.begin("bricks");
  state.bricks = layOutBricks(surface, state.parts, brickGrid, run.monitor);
  state.bricks.here.isShare = state.layersHere.has_value();
  if (state.keeping) state.kept = &state.keeping->bricks();
  state.cuts = cutBricks(surface, state.parts, state.bricks, run, state.kept);
  if (!state.isNeededAgain) state.parts = {};
  state.used = findUsed(surface, state.bricks, state.cuts, run);
}

void joinBricks(CutState& state, Clock& clock, Run& run) {
  const Input& input = state.surface.input;
  clock.begin("regions");
  state.runs = findUntouchedRuns(input, state.bricks, {0, input.cells(2)}, run.monitor);
  if (state.keeping) state.seams = state.keeping->seams();
  findSeams(state.cut(), state.kept, state.seams, run);
  state.regions = findRegions(state.cut());
}

CutMesh cutInput(CutState& state, const MeshView& mesh, const Grid& grid, Clock& clock, Run& run) {
  cutInBricks(state, clock, run);
  joinBricks(state, clock, run);
  clock.begin("output");
  std::vector<CutPart> whole;
  whole.push_back(makePart(mesh, grid, state, run));
  return makeOutput(std::move(whole), state, run);
}

CutMesh cutPrepared(CutState& state, const MeshView& mesh, const Grid& grid, Clock& clock, Run& run) {
  try {
    return cutInput(state, mesh, grid, clock, run);
  } catch (const Failure& failure) {
    if (failure.error.status != Status::selfIntersection) throw;
    clock.begin("intersections");
    throw Failure{explainContradiction(state.surface.input, failure.error.element, failure.error.element2, run)};
  }
}

Fingerprint fingerprintOfCut(Fingerprint mesh, const Grid& grid, const CutOptions& options) {
  Fingerprinter fingerprinter("cut", mesh);
  for (const std::vector<double>& planes : grid.planes) fingerprinter.add(planes);
  fingerprinter.add(options.snapTolerance);
  fingerprinter.add(uint64_t(options.intersections));
  return fingerprinter.get();
}

void sign(CutMesh& cutMesh, Fingerprint mesh, const CutOptions& options) {
  cutMesh.snapTolerance = options.snapTolerance;
  cutMesh.madeFrom = mesh;
  cutMesh.fingerprint = fingerprintOfCut(mesh, cutMesh.grid, options);
}

}  // namespace detail

using namespace detail;

MeshView PreparedMesh::mesh() const { return data_ ? MeshView(*data_->mesh) : MeshView({}, {}); }

PrepareResult prepare(const MeshView& mesh, const PrepareOptions& options) { return prepareThis(mesh, options); }

CutResult cut(const PreparedMesh& mesh, const Grid& grid, const CutOptions& options) {
  const PreparedMeshData* data = mesh.data();
  if (!data) return cut(mesh.mesh(), grid, options);
  CutResult result;
  catchErrors(result.error, "cut", [&] {
    checkGrid(grid, options.snapTolerance);
    CutOptions same = options;
    same.intersections = data->intersections;
    if (options.snapTolerance > 0 || !fits(data->prepared->shift, grid)) {
      result = cut(*data->mesh, grid, same);
      return;
    }
    Monitor monitor(options, kGridStages);
    Clock clock(result.stats, monitor);
    Run run{result.stats, monitor};
    makeRoomFor(data->mesh->triangleCount(), monitor);
    CutState state;
    beginCut(*data->prepared, grid, state, clock, run);
    result.mesh = cutPrepared(state, *data->mesh, grid, clock, run);
    sign(result.mesh, data->fingerprint, same);
  });
  return result;
}

CutResult cut(const MeshView& mesh, const Grid& grid, const CutOptions& options) {
  CutResult result;
  catchErrors(result.error, "cut", [&] {
    Monitor monitor(options, kMeshStages + kGridStages);
    Clock clock(result.stats, monitor);
    Run run{result.stats, monitor};
    checkGrid(grid, options.snapTolerance);
    const SnappedInput input(mesh, grid, options, result.stats);
    Fingerprint fingerprint;
    const Preparation preparation{largestCoordinate(grid), options.intersections, false, [&] { fingerprint = fingerprintOf(mesh); }};
    const auto prepared = prepareMesh(input.view(), preparation, monitor, [&](const char* stage) { clock.begin(stage); });
    CutState state;
    beginCut(*prepared, grid, state, clock, run);
    result.mesh = cutPrepared(state, input.view(), grid, clock, run);
    sign(result.mesh, fingerprint, options);
  });
  return result;
}

}  // namespace mandoline
