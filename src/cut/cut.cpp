// The driver: Algorithm 1 of the paper, bottom-up. Each stage has its own header, which is its contract.
#include <chrono>
#include <new>
#include <stdexcept>

#include "cut/contradiction.h"
#include "cut/stages/input.h"
#include "cut/stages/output.h"

namespace mandoline {
namespace {

using namespace detail;

/// Names the stages for progress and takes their times.
class Clock {
 public:
  static constexpr int kStages = 9;

  Clock(CutStats& stats, Monitor& monitor) : stats_(stats), monitor_(monitor), start_(now()), last_(start_) {}
  ~Clock() { end(); }  // also of a cut that failed

  void begin(const char* stage) {
    end();
    stats_.stages.push_back({stage, 0});
    monitor_.beginStage(stage, int(stats_.stages.size()) - 1);
  }

 private:
  void end() {
    const double t = now();
    if (!stats_.stages.empty()) stats_.stages.back().ms = t - last_;
    stats_.totalMs = t - start_;
    last_ = t;
  }
  static double now() { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

  CutStats& stats_;
  Monitor& monitor_;
  double start_, last_;
};

CutMesh cutMesh(const MeshView& mesh, const Grid& grid, const CutOptions& options, CutStats& stats) {
  Monitor monitor(options, Clock::kStages);
  Clock clock(stats, monitor);
  Run run{stats, monitor};
  CutState state;
  auto& [surface, stencil, faces, cells, regions] = state;

  clock.begin("input");
  surface.input = prepareInput(mesh, grid, options.snapTolerance, run);
  try {
    clock.begin("triEdges");
    cutTriEdges(surface, run);

    clock.begin("triFaces");
    faces.tri = cutTriangles(surface, run);

    clock.begin("stencil");
    stencil = makeStencil(surface, faces.tri, run);

    clock.begin("gridEdges");
    const GridEdges gridEdges = cutGridEdges(stencil, faces.tri, surface.vertices, run);

    clock.begin("gridFaces");
    faces.grid = cutGridFaces(surface, stencil, gridEdges, faces.tri, run);

    clock.begin("cutCells");
    cells = makeCutCells(surface, stencil, faces, run);

    clock.begin("regions");
    regions = findRegions(surface, stencil, faces, cells, run);

    clock.begin("output");
    return makeOutput(mesh, grid, state, run);
  } catch (const Failure& failure) {
    if (failure.error.status != Status::selfIntersection) throw;
    throw Failure{explainContradiction(surface.input, failure.error.element, failure.error.element2, stats)};
  }
}

}  // namespace

CutResult cut(const MeshView& mesh, const Grid& grid, const CutOptions& options) {
  CutResult result;
  try {
    result.mesh = cutMesh(mesh, grid, options, result.stats);
  } catch (const Failure& failure) {
    result.error = failure.error;
  } catch (const Cancelled&) {
    result.error = {Status::cancelled, -1, -1, "The cut was cancelled."};
  } catch (const ProgressFailed& failure) {
    std::rethrow_exception(failure.exception);
  } catch (const std::bad_alloc&) {
    result.error = {Status::outOfMemory, -1, -1, "There is not enough memory for this cut."};
  } catch (const std::length_error&) {
    result.error = {Status::outOfMemory, -1, -1, "There is not enough memory for this cut."};
  }
  return result;
}

}  // namespace mandoline
