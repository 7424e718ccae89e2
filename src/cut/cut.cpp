// The driver: Algorithm 1 of the paper, bottom-up. Each stage has its own header, which is its contract.
#include <chrono>

#include "cut/contradiction.h"
#include "cut/driver.h"
#include "cut/stages/divided_faces.h"
#include "cut/stages/input.h"
#include "grid/snap.h"
#include "mandoline/orient.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"

namespace mandoline {

namespace detail {
namespace {

double now() { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr int kOrientStages = 2, kMeshStages = 2, kGridStages = 6;

/// Adds the counts of a mesh's preparation.
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

/// `mesh` is the one that was prepared.
CutMesh cutPrepared(const Prepared& prepared, const MeshView& mesh, const Grid& grid, Clock& clock, Run& run) {
  addCounts(prepared, run.stats);
  clock.begin("grid");
  CutState state;
  state.surface.input = prepareInput(prepared, grid, run);
  try {
    return cutInput(state, mesh, grid, clock, run);
  } catch (const Failure& failure) {
    if (failure.error.status != Status::selfIntersection) throw;
    clock.begin("intersections");
    throw Failure{explainContradiction(state.surface.input, failure.error.element, failure.error.element2, run)};
  }
}

}  // namespace

Clock::Clock(CutStats& stats, Monitor& monitor, int before)
    : stats_(stats), monitor_(monitor), before_(before), start_(now()), last_(start_) {}

void Clock::begin(const char* stage) {
  end();
  stats_.stages.push_back({stage, 0});
  monitor_.beginStage(stage, before_ + int(stats_.stages.size()) - 1);
}

void Clock::end() {
  const double t = now();
  if (!stats_.stages.empty()) stats_.stages.back().ms = t - last_;
  stats_.totalMs = t - start_;
  last_ = t;
}

bool fits(const Prepared& prepared, const Grid& grid) {
  const double largest = largestCoordinate(grid);
  return largest == 0 || std::ilogb(largest) + prepared.shift <= Scale::kLargestExponent + Scale::kRoom;
}

CutMesh cutInput(CutState& state, const MeshView& mesh, const Grid& grid, Clock& clock, Run& run) {
  Surface& surface = state.surface;
  const Input& input = surface.input;

  clock.begin("triEdges");
  cutTriEdges(surface, run);

  clock.begin("triFaces");
  const BrickGrid brickGrid(input, BrickGrid::shiftFor(input, run.monitor.threads()));
  state.parts.clipped = clipTriangles(surface, brickGrid, run);
  divideFaces(surface, state.parts.clipped.undivided, state.parts.divided, run);

  clock.begin("bricks");
  state.bricks = layOutBricks(surface, state.parts, brickGrid);
  state.cuts = cutBricks(surface, state.parts, state.bricks, run);

  clock.begin("regions");
  state.runs = findUntouchedRuns(input, state.bricks, run.monitor);
  state.seams = findSeams(input, state.bricks, state.runs, state.cuts, run);
  state.regions = findRegions(state.cut());

  clock.begin("output");
  CutMesh result = makeOutput(mesh, grid, state, run);
  run.stats.madeVertices = uint32_t(result.madeVertices.size());
  return result;
}

void sign(CutMesh& cutMesh, Fingerprint mesh, const CutOptions& options) {
  Fingerprinter fingerprinter("cut", mesh);
  for (const std::vector<double>& planes : cutMesh.grid.planes) fingerprinter.add(planes);
  fingerprinter.add(options.snapTolerance);
  fingerprinter.add(uint64_t(options.intersections));
  cutMesh.snapTolerance = options.snapTolerance;
  cutMesh.madeFrom = mesh;
  cutMesh.fingerprint = fingerprinter.get();
}

}  // namespace detail

using namespace detail;

MeshView PreparedMesh::mesh() const { return data_ ? MeshView(data_->mesh) : MeshView({}, {}); }

PrepareResult prepare(const MeshView& mesh, const PrepareOptions& options) {
  PrepareResult result;
  catchErrors(result.error, "preparation", [&] {
    const int before = options.orient ? kOrientStages : 0;
    Monitor monitor(options, before + kMeshStages);
    auto data = std::make_shared<PreparedMeshData>();
    if (options.orient) {
      data->mesh = orient(mesh, monitor.part<RunOptions>(0, kMeshStages)).mesh;
    } else {
      data->mesh = {{mesh.positions.begin(), mesh.positions.end()}, {mesh.triangles.begin(), mesh.triangles.end()}};
    }
    Clock clock(result.stats, monitor, before);
    data->intersections = options.intersections;
    data->prepared = prepareMesh(data->mesh, {0, options.intersections}, monitor, [&](const char* stage) { clock.begin(stage); });
    data->fingerprint = fingerprintOf(data->mesh);
    addCounts(*data->prepared, result.stats);
    result.mesh = PreparedMesh(std::move(data));
  });
  return result;
}

CutResult cut(const PreparedMesh& mesh, const Grid& grid, const CutOptions& options) {
  const PreparedMeshData* data = mesh.data();
  if (!data) return cut(mesh.mesh(), grid, options);
  CutResult result;
  catchErrors(result.error, "cut", [&] {
    checkGrid(grid, options.snapTolerance);
    CutOptions same = options;
    same.intersections = data->intersections;
    if (options.snapTolerance > 0 || !fits(*data->prepared, grid)) {
      result = cut(data->mesh, grid, same);
      return;
    }
    Monitor monitor(options, kGridStages);
    Clock clock(result.stats, monitor);
    Run run{result.stats, monitor};
    result.mesh = cutPrepared(*data->prepared, data->mesh, grid, clock, run);
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
    SnappedMesh moved;
    if (options.snapTolerance > 0) {
      moved = snapped(mesh, grid, options.snapTolerance);
      result.stats.snappedVertices = moved.vertices;
      result.stats.largestSnap = moved.largest;
    }
    const MeshView input = options.snapTolerance > 0 ? MeshView(moved.mesh) : mesh;
    const auto prepared =
        prepareMesh(input, {largestCoordinate(grid), options.intersections}, monitor, [&](const char* stage) { clock.begin(stage); });
    result.mesh = cutPrepared(*prepared, input, grid, clock, run);
    sign(result.mesh, fingerprintOf(mesh), options);
  });
  return result;
}

}  // namespace mandoline
