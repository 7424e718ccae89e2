// The driver: Algorithm 1 of the paper, bottom-up. Each stage has its own header, which is its contract.
#include <chrono>
#include <new>
#include <stdexcept>

#include "cut/stages/output.h"
#include "mesh/intersections.h"

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

CutMesh cutInput(const MeshView& mesh, const Grid& grid, Input& input, CutStats& stats, Clock& clock, Monitor& monitor) {
  clock.begin("triEdges");
  TriEdges edges;
  CutVertices vertices;
  cutTriEdges(input, edges, vertices, stats, monitor);

  clock.begin("triFaces");
  TriFaces triFaces = cutTriangles(input, edges, vertices, stats, monitor);

  clock.begin("stencil");
  const Stencil stencil = makeStencil(input, edges, triFaces, monitor);

  clock.begin("gridEdges");
  const GridEdges gridEdges = cutGridEdges(stencil, triFaces, vertices, stats, monitor);

  clock.begin("gridFaces");
  GridFaces gridFaces = cutGridFaces(input, stencil, gridEdges, triFaces, vertices, stats, monitor);

  clock.begin("cutCells");
  CutCells cells = makeCutCells(input, edges, stencil, triFaces, gridFaces, vertices, stats, monitor);

  clock.begin("regions");
  Regions regions = findRegions(input, edges, stencil, triFaces, gridFaces, cells, vertices, stats, monitor);

  clock.begin("output");
  return makeOutput(mesh, grid, input, stencil, std::move(triFaces), std::move(gridFaces), std::move(cells), std::move(regions), vertices,
                    stats, monitor);
}

CutMesh cutMesh(const MeshView& mesh, const Grid& grid, const CutOptions& options, CutStats& stats) {
  Monitor monitor(options, Clock::kStages);
  Clock clock(stats, monitor);

  clock.begin("input");
  Input input = prepareInput(mesh, grid, options.snapTolerance, stats, monitor);
  try {
    return cutInput(mesh, grid, input, stats, clock, monitor);
  } catch (const Failure& failure) {
    if (failure.error.status != Status::selfIntersection) throw;
    throw Failure{explainContradiction(input, failure.error.element, failure.error.element2, stats)};
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
