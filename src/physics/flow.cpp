#include "mandoline/flow.h"

#include <algorithm>
#include <cmath>

#include "mesh/run_call.h"
#include "operators/measure/vector.h"
#include "operators/require_cut_mesh.h"
#include "physics/dual_edges.h"
#include "physics/flow_data.h"

namespace mandoline {
namespace {

/// The boundary of a wind, one of length 1, that blows through the sides of the box; as much in as out of each component.
Boundary windBoundary(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<uint32_t>& throttled) {
  Boundary boundary = boundaryOf(cells);
  const CellComponents components = cellComponents(cells);
  const std::vector<double> normals = outwardNormals(boundary, cells);
  std::vector<double> in(components.count), out(components.count);
  const auto component = [&](size_t b) { return components.cellComponent[size_t(cells.faceCells[boundary.halfFaces[b]])]; };
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t face = boundary.halfFaces[b] / 2;
    if (cells.faceTag[face] >= FaceTag::inner) continue;
    for (size_t d = 0; d < 3; ++d) boundary.value[b] += wind[d] * normals[3 * b + d];
    (boundary.value[b] < 0 ? in : out)[component(b)] += std::fabs(boundary.value[b]) * cells.faceArea[face];
  }
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t r = component(b);
    const double mine = boundary.value[b] < 0 ? in[r] : out[r];
    if (mine > 0) boundary.value[b] *= std::min(in[r], out[r]) / mine;
  }
  for (uint32_t r = 0; r < components.count; ++r) {
    if (std::fabs(in[r] - out[r]) > 1e-9 * (in[r] + out[r])) throttled.push_back(r);  // more than rounding
  }
  return boundary;
}

/// From that of a wind of length 1.
void scale(Flow& flow, double length) {
  for (std::vector<double>* values : {&flow.phi, &flow.faceVelocity, &flow.cellVelocity, &flow.cellGradient}) {
    for (double& value : *values) value *= length;
  }
}

class FlowSolver {
 public:
  FlowSolver(const CellComplex& cells, const FlowOptions& options) : cells_(cells), options_(options) {}

  Flow run(const std::array<double, 3>& wind) {
    Flow flow;
    flow.wind = wind;
    const double length = measuring::length(wind);
    std::array<double, 3> unit{};
    for (size_t d = 0; d < 3 && length > 0; ++d) unit[d] = wind[d] / length;
    PoissonProblem problem;
    problem.boundary = windBoundary(cells_, unit, flow.throttled);
    solve(problem, flow);
    const physics::DualEdges dual = physics::dualEdges(cells_, problem.dualPoints);
    physics::fillFaceVelocities(cells_, problem.boundary, dual, flow);
    detail::Monitor monitor(options_, kStages);
    monitor.beginStage("velocities", kStages - 1);
    fitVelocities(cells_, physics::flowData(cells_, dual, flow), monitor, flow);
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      double square = 0;
      for (size_t d = 0; d < 3; ++d) square += flow.cellVelocity[3 * c + d] * flow.cellVelocity[3 * c + d];
      flow.cellPressure.push_back(length > 0 ? 1 - square : 0);
    }
    scale(flow, length);
    return flow;
  }

 private:
  static constexpr int kStages = 3;  // the solver's two and the velocities

  void solve(const PoissonProblem& problem, Flow& flow) const {
    SolveOptions options;
    static_cast<RunOptions&>(options) = options_;
    options.tolerance = options_.tolerance;
    options.maxIterations = options_.maxIterations;
    if (options_.progress) {
      options.progress = [&](Progress progress) {
        progress.stageCount = kStages;
        return options_.progress(progress);
      };
    }
    Solution solution = solvePoisson(cells_, problem, options);
    flow.status = solution.status;
    flow.phi = std::move(solution.phi);
    flow.residuals = std::move(solution.residuals);
  }

  const CellComplex& cells_;
  const FlowOptions& options_;
};

}  // namespace

Flow solveFlow(const CellComplex& cells, const std::array<double, 3>& wind, const FlowOptions& options) {
  const bool isFinite = std::isfinite(wind[0]) && std::isfinite(wind[1]) && std::isfinite(wind[2]);
  if (!isFinite || !std::isfinite(measuring::length(wind))) operators::refuse("The wind is not finite.");
  return detail::runCall("flow", [&] { return FlowSolver(cells, options).run(wind); });
}

}  // namespace mandoline
