#include "mandoline/heat.h"

#include <cmath>

#include "physics/poisson_problem.h"

namespace mandoline {
namespace {

/// Of the time step, each stage's part: 1 - sqrt(1/2).
constexpr double kStage = 0.29289321881345248;

PoissonProblem stageProblem(const CellComplex& cells, const HeatProblem& heat) {
  if (!(heat.timeStep > 0 && std::isfinite(1 / heat.timeStep)))
    throw CallError({Status::badOption, -1, -1, "The time step has to be positive."});
  physics::requireCellValues(cells, heat.phi, {"values of phi", "phi"});
  PoissonProblem problem = heat.problem;
  if (problem.mass.empty()) problem.mass.resize(cells.cellCount());
  for (double& mass : problem.mass) mass += 1 / (kStage * heat.timeStep);
  return problem;
}

}  // namespace

HeatStepper::HeatStepper(const CellComplex& cells, HeatProblem heat, unsigned threads)
    : solver_(cells, stageProblem(cells, heat), threads),
      source_(std::move(heat.problem.source)),
      boundaryValue_(std::move(heat.problem.boundary.value)),
      phi_(std::move(heat.phi)),
      timeStep_(heat.timeStep) {}

SolveStatus HeatStepper::step(const SolveOptions& options) {
  const double mass = 1 / (kStage * timeStep_);
  std::vector<double> from = phi_, start = phi_, source;
  for (int stage = 0; stage < 2; ++stage) {
    source = source_;
    if (source.empty()) source.resize(phi_.size());
    for (size_t c = 0; c < source.size() && c < phi_.size(); ++c) source[c] -= mass * from[c];
    Solution solution = solver_.solve({source, boundaryValue_, start}, options);
    if (!isSolved(solution.status)) return solution.status;
    // From phi the second stage goes on with what the first one found of d phi / dt, for the rest of the step.
    for (size_t c = 0; c < phi_.size() && stage == 0; ++c) from[c] += (1 - kStage) / kStage * (solution.phi[c] - phi_[c]);
    start = solution.phi;
    solution_ = std::move(solution);
  }
  phi_ = std::move(start);
  ++steps_;
  return SolveStatus::converged;
}

}  // namespace mandoline
