#include "mandoline/flow.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/large_array.h"
#include "mesh/run_call.h"
#include "operators/measure/vector.h"
#include "operators/require_cut_mesh.h"
#include "physics/cell_edges.h"
#include "physics/cell_velocities.h"
#include "physics/far_field.h"
#include "physics/flow_of_phi.h"
#include "physics/node_loops.h"
#include "physics/poisson_setup.h"
#include "physics/wind.h"

namespace mandoline {
namespace {

std::array<double, 3> unitOf(const std::array<double, 3>& wind) {
  const double length = measuring::length(wind);
  std::array<double, 3> unit{};
  for (size_t d = 0; d < 3 && length > 0; ++d) unit[d] = wind[d] / length;
  return unit;
}

/// Turns the flow of a wind of length 1 into that of a wind of the given length. Returns whether all is finite.
bool scale(Flow& flow, double length, const detail::Team& team) {
  bool isFinite = true;
  for (std::vector<double>* values : {&flow.phi, &flow.faceVelocity, &flow.cellVelocity, &flow.cellGradient}) {
    physics::forBlocks(values->size(), team, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) (*values)[i] *= length;
    });
    isFinite &= physics::areFinite(*values, team);
  }
  return isFinite;
}

/// What follows from phi and the velocities on faces of a wind of length 1; then all for one of the given length.
void complete(const physics::FitSource& source, physics::CellFitter* fitter, double length, detail::Monitor& monitor, Flow& flow) {
  physics::fillVelocities(source, fitter, monitor, flow);
  detail::makeLargeOnThreads(flow.cellPressure, source.cells.cellCount(), monitor.threads());
  physics::forBlocks(flow.cellPressure.size(), monitor.threads(), [&](size_t begin, size_t end) {
    for (size_t c = begin; c < end; ++c) {
      double square = 0;
      for (size_t d = 0; d < 3; ++d) square += flow.cellVelocity[3 * c + d] * flow.cellVelocity[3 * c + d];
      flow.cellPressure[c] = length > 0 ? 1 - square : 0;
    }
  });
  if (!scale(flow, length, monitor.threads())) flow.status = SolveStatus::breakdown;
}

class FlowSolver {
 public:
  FlowSolver(const CellComplex& cells, const FlowOptions& options) : cells_(cells), options_(options) {}

  Flow run(const std::array<double, 3>& wind) {
    Flow flow;
    flow.madeFrom = cells_.fingerprint;
    flow.wind = wind;
    const double length = measuring::length(wind);
    PoissonProblem problem;
    detail::Monitor monitor(options_, kStages);
    problem.boundary = physics::windBoundary(cells_, unitOf(wind), flow.throttled, monitor.threads());
    physics::FarFieldShare share;
    std::optional<physics::FarField> farField;
    if (options_.farField) {
      requireWallsOffSides(problem.boundary);
      share.parts = physics::partsBetweenSlits(cells_);
      farField.emplace(cells_, problem.boundary, share);
    }
    monitor.beginStage("levels", 0);
    physics::PoissonSetup setup(cells_, problem, monitor.threads());
    const SolveOptions options = solveOptions(monitor);
    if (farField && farField->hasDipoles())
      solveFarField(*farField, setup, options, problem.boundary, flow);
    else
      solve(setup, options, problem.boundary, flow);
    monitor.beginStage("velocities", kStages - 1);
    complete({cells_, setup.dual, setup.edgesOfCells, problem}, setup.fitter ? &*setup.fitter : nullptr, length, monitor, flow);
    return flow;
  }

 private:
  static constexpr int kStages = 3;  // the solver's two and the velocities

  SolveOptions solveOptions(detail::Monitor& monitor) const {
    auto options = monitor.part<SolveOptions>(1, 1);
    options.tolerance = options_.tolerance;
    options.maxIterations = options_.maxIterations;
    options.corrections = options_.corrections;
    physics::requireOptions(options);
    return options;
  }

  void requireWallsOffSides(const Boundary& boundary) const {
    if (const auto face = physics::wallOnSide(cells_, boundary, {}))
      operators::refuse("With the far field no wall may reach a side of the box, but face " + std::to_string(*face) + " does.", *face);
  }

  void solveFarField(const physics::FarField& farField, physics::PoissonSetup& setup, SolveOptions options, Boundary& boundary,
                     Flow& flow) const {
    using Next = physics::FarFieldPasses::Next;
    const auto progress = options.progress;
    physics::FarFieldPasses passes(farField, boundary.value);
    Next next = Next::pass;
    for (int pass = 0; next == Next::pass; ++pass) {
      if (progress) options.progress = [&](const Progress& p) { return progress(partOfPasses(p, pass)); };
      options.tolerance = pass == 0 ? std::max(options_.tolerance, kLoose) : options_.tolerance;
      solve(setup, options, boundary, flow);
      if (flow.status != SolveStatus::converged) return;
      next = passes.add(flow, boundary.value);
    }
    if (next == Next::limit) flow.status = SolveStatus::iterationLimit;
  }

  /// Each pass has half of what is left.
  static Progress partOfPasses(Progress progress, int pass) {
    const double left = std::ldexp(1.0, -pass);
    progress.done = size_t(1000 * (1 - left + left / 2 * double(progress.done) / double(progress.total)));
    progress.total = 1000;
    return progress;
  }

  /// Goes on from the flow's phi, if there is one.
  void solve(physics::PoissonSetup& setup, const SolveOptions& options, const Boundary& boundary, Flow& flow) const {
    Solution solution = physics::solveOnly(setup, {{}, boundary.value, flow.phi}, options, "flow");
    flow.status = isSolved(solution.status) ? SolveStatus::converged : solution.status;  // what flows is known
    flow.phi = std::move(solution.phi);
    if (!flow.residuals.empty()) flow.residuals.pop_back();
    flow.residuals.insert(flow.residuals.end(), solution.residuals.begin(), solution.residuals.end());
    flow.faceVelocity = std::move(solution.faceDerivative);
    physics::setOnBoundary(boundary, flow.faceVelocity);
  }

  static constexpr double kLoose = 1e-3;  ///< the tolerance of the first pass, which only dipoles follow from

  const CellComplex& cells_;
  const FlowOptions& options_;
};

/// What of the corrections is on sides of the box passes through these.
void addOnSides(const CellComplex& cells, std::span<const physics::FaceCorrection> corrections, double length, Boundary& boundary) {
  for (const auto& [face, velocity] : corrections) {
    if (cells.faceTag[face] >= FaceTag::inner || length == 0) continue;
    const uint32_t h = 2 * face + (cells.faceCells[2 * size_t(face)] < 0 ? 1 : 0);
    const auto at = std::lower_bound(boundary.halfFaces.begin(), boundary.halfFaces.end(), h) - boundary.halfFaces.begin();
    boundary.value[size_t(at)] += (h % 2 == 0 ? velocity : -velocity) / length;
  }
}

}  // namespace

void physics::setOnBoundary(const Boundary& boundary, std::vector<double>& faceVelocity) {
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    const double value = boundary.value[b];
    if (value != 0) faceVelocity[h / 2] = h % 2 == 0 ? value : -value;
  }
}

Flow physics::flowOfPhi(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<double> phi,
                        std::span<const FaceCorrection> corrections, const RunOptions& options) {
  return detail::runCall("flow", [&] {
    Flow flow;
    flow.madeFrom = cells.fingerprint;
    flow.wind = wind;
    flow.phi = std::move(phi);
    const double length = measuring::length(wind);
    for (double& value : flow.phi) value = length > 0 ? value / length : 0;
    PoissonProblem problem;
    detail::Monitor monitor(options, 1);
    problem.boundary = windBoundary(cells, unitOf(wind), flow.throttled, monitor.threads());
    addOnSides(cells, corrections, length, problem.boundary);
    const DualEdges dual = dualEdges(cells, problem.dualPoints, {}, monitor.threads());
    const std::vector<BoundaryTerm> terms = boundaryTerms(cells, problem);
    const detail::Csr<uint32_t> edges = cellEdges(cells, dual, monitor.threads());
    flow.faceVelocity = Differentiator({cells, dual, edges, problem}, terms, monitor.threads()).plain(flow.phi, monitor.threads());
    flow.faceVelocity.resize(cells.faceCount());
    for (const auto& [face, velocity] : corrections) {
      if (cells.faceTag[face] >= FaceTag::inner) flow.faceVelocity[face] += length > 0 ? velocity / length : 0;
    }
    setOnBoundary(problem.boundary, flow.faceVelocity);
    monitor.beginStage("velocities", 0);
    complete({cells, dual, edges, problem}, nullptr, length, monitor, flow);
    return flow;
  });
}

Flow solveFlow(const CellComplex& cells, const std::array<double, 3>& wind, const FlowOptions& options) {
  const bool isNumber = std::isfinite(wind[0]) && std::isfinite(wind[1]) && std::isfinite(wind[2]);
  if (!isNumber || !std::isfinite(measuring::length(wind))) operators::refuse("The wind is not finite.");
  return detail::runCall("flow", [&] { return FlowSolver(cells, options).run(wind); });
}

}  // namespace mandoline
