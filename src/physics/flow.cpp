#include "mandoline/flow.h"

#include <algorithm>
#include <cmath>

#include "mesh/run_call.h"
#include "operators/measure/vector.h"
#include "operators/require_cut_mesh.h"
#include "physics/dual_edges.h"
#include "physics/flow_data.h"
#include "physics/joined_cells.h"

namespace mandoline {
namespace {

/// The components, divided where cells are connected by slits alone: faces with less than a millionth of the area of other faces of both
/// cells. A wind that had to pass through those would be absurdly fast.
CellComponents partsBetweenSlits(const CellComplex& cells) {
  constexpr double kSlit = 1e-6;
  std::vector<double> largest(cells.cellCount());
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    for (const uint32_t h : cells.halfFaces(c)) largest[c] = std::max(largest[c], cells.faceArea[h / 2]);
  }
  return physics::joinedCells(cells, [&](size_t f) {
    const double smaller = std::min(largest[size_t(cells.faceCells[2 * f])], largest[size_t(cells.faceCells[2 * f + 1])]);
    return cells.faceArea[f] >= kSlit * smaller;
  });
}

/// The boundary for a wind of length 1 that blows through the sides of the box, as much into each part as out of it.
Boundary windBoundary(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<uint32_t>& throttled) {
  Boundary boundary = boundaryOf(cells);
  const CellComponents parts = partsBetweenSlits(cells), components = cellComponents(cells);
  const std::vector<double> normals = outwardNormals(boundary, cells);
  std::vector<double> in(parts.count), out(parts.count), all(components.count), lost(components.count);
  const auto cellOf = [&](size_t b) { return size_t(cells.faceCells[boundary.halfFaces[b]]); };
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t face = boundary.halfFaces[b] / 2;
    if (cells.faceTag[face] >= FaceTag::inner) continue;
    for (size_t d = 0; d < 3; ++d) boundary.value[b] += wind[d] * normals[3 * b + d];
    (boundary.value[b] < 0 ? in : out)[parts.cellComponent[cellOf(b)]] += std::fabs(boundary.value[b]) * cells.faceArea[face];
  }
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t p = parts.cellComponent[cellOf(b)], r = components.cellComponent[cellOf(b)];
    const double mine = boundary.value[b] < 0 ? in[p] : out[p],
                 flux = std::fabs(boundary.value[b]) * cells.faceArea[boundary.halfFaces[b] / 2];
    if (!(mine > 0)) continue;
    const double kept = std::min(in[p], out[p]) / mine;
    boundary.value[b] *= kept;
    all[r] += flux, lost[r] += flux * (1 - kept);
  }
  for (uint32_t r = 0; r < components.count; ++r) {
    if (lost[r] > 1e-9 * all[r]) throttled.push_back(r);  // more than rounding
  }
  return boundary;
}

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
    problem.boundary = windBoundary(cells_, unit, flow.throttled);
    detail::Monitor monitor(options_, kStages);
    solve(problem, monitor, flow);
    const physics::DualEdges dual = physics::dualEdges(cells_, problem.dualPoints);
    physics::fillFaceVelocities(cells_, problem.boundary, dual, flow);
    monitor.beginStage("velocities", kStages - 1);
    fitVelocities(cells_, physics::flowData(cells_, dual, flow), monitor, flow);
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
  const bool isNumber = std::isfinite(wind[0]) && std::isfinite(wind[1]) && std::isfinite(wind[2]);
  if (!isNumber || !std::isfinite(measuring::length(wind))) operators::refuse("The wind is not finite.");
  return detail::runCall("flow", [&] { return FlowSolver(cells, options).run(wind); });
}

}  // namespace mandoline
