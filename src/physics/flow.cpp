#include "mandoline/flow.h"

#include <algorithm>
#include <cmath>

#include "mesh/run_call.h"
#include "operators/measure/vector.h"
#include "operators/require_cut_mesh.h"
#include "physics/cell_velocities.h"
#include "physics/wind.h"

namespace mandoline {
namespace {

/// Turns the flow of a wind of length 1 into that of a wind of the given length.
void scale(Flow& flow, double length) {
  for (std::vector<double>* values : {&flow.phi, &flow.faceVelocity, &flow.cellVelocity, &flow.cellGradient}) {
    for (double& value : *values) value *= length;
  }
}

bool isFinite(const Flow& flow) {
  const auto areFinite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  return areFinite(flow.phi) && areFinite(flow.faceVelocity) && areFinite(flow.cellVelocity) && areFinite(flow.cellGradient);
}

class FlowSolver {
 public:
  FlowSolver(const CellComplex& cells, const FlowOptions& options) : cells_(cells), options_(options) {}

  Flow run(const std::array<double, 3>& wind) {
    Flow flow;
    flow.madeFrom = cells_.fingerprint;
    flow.wind = wind;
    const double length = measuring::length(wind);
    std::array<double, 3> unit{};
    for (size_t d = 0; d < 3 && length > 0; ++d) unit[d] = wind[d] / length;
    PoissonProblem problem;
    problem.boundary = physics::windBoundary(cells_, unit, flow.throttled);
    detail::Monitor monitor(options_, kStages);
    solve(problem, monitor, flow);
    monitor.beginStage("velocities", kStages - 1);
    physics::fillVelocities(cells_, problem, monitor, flow);
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      double square = 0;
      for (size_t d = 0; d < 3; ++d) square += flow.cellVelocity[3 * c + d] * flow.cellVelocity[3 * c + d];
      flow.cellPressure.push_back(length > 0 ? 1 - square : 0);
    }
    scale(flow, length);
    if (!isFinite(flow)) flow.status = SolveStatus::breakdown;
    return flow;
  }

 private:
  static constexpr int kStages = 3;  // the solver's two and the velocities

  void solve(const PoissonProblem& problem, detail::Monitor& monitor, Flow& flow) const {
    auto options = monitor.part<SolveOptions>(0, 1);
    options.tolerance = options_.tolerance;
    options.maxIterations = options_.maxIterations;
    options.corrections = options_.corrections;
    Solution solution = solvePoisson(cells_, problem, options);
    flow.status = solution.status;
    flow.phi = std::move(solution.phi);
    flow.residuals = std::move(solution.residuals);
    flow.faceVelocity = std::move(solution.faceDerivative);
    for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
      const uint32_t h = problem.boundary.halfFaces[b];
      const double value = problem.boundary.value[b];
      if (value != 0) flow.faceVelocity[h / 2] = h % 2 == 0 ? value : -value;
    }
  }

  const CellComplex& cells_;
  const FlowOptions& options_;
};

}  // namespace

Flow solveFlow(const CellComplex& cells, const std::array<double, 3>& wind, const FlowOptions& options) {
  const bool isNumber = std::isfinite(wind[0]) && std::isfinite(wind[1]) && std::isfinite(wind[2]);
  if (!isNumber || !std::isfinite(measuring::length(wind))) operators::refuse("The wind is not finite.");
  return detail::runCall("flow", [&] { return FlowSolver(cells, options).run(wind); });
}

}  // namespace mandoline
