#include "mandoline/unsteady.h"

#include <algorithm>
#include <cmath>

#include "physics/advection.h"
#include "physics/flow_state.h"

namespace mandoline {

using Vector = std::vector<double>;

namespace {

PoissonProblem pressureProblem(const physics::FlowBoundary& boundary) {
  PoissonProblem problem;
  problem.boundary = boundary.ofPressure();
  problem.dualPoints = DualPoints::centroids;
  return problem;
}

bool areFinite(const Vector& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

double largest(const Vector& values) {
  double result = 0;
  for (const double v : values) result = std::max(result, std::fabs(v));
  return result;
}

/// That of a grid cell's side, at least about.
double sideArea(const CellComplex& cells) {
  double volume = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) volume = std::max(volume, cells.cellVolume[c] / std::pow(8.0, cells.cellLevel[c]));
  return std::pow(volume, 2.0 / 3);
}

}  // namespace

FlowStepper::State::State(const CellComplex& cells, const std::array<double, 3>& wind, const FlowStepperOptions& options)
    : cells_(cells),
      wind_(wind),
      options_(options),
      boundary_(cells, wind),
      flowCells_(cells, options.viscosity > 0 ? std::span<const uint32_t>(boundary_.surface) : std::span<const uint32_t>(),
                 boundary_.outlets),
      pressure_(cells, pressureProblem(boundary_), options.threads),
      area_(sideArea(cells)) {
  flow_.madeFrom = cells.fingerprint;
  start(windAtStart());
}

/// The wind, but rest in components that it does not blow through.
Vector FlowStepper::State::windAtStart() const {
  const CellComponents components = cellComponents(cells_);
  std::vector<char> isOpen(components.count);
  for (const uint32_t h : boundary_.outlets) isOpen[components.cellComponent[size_t(cells_.faceCells[h])]] = 1;
  Vector velocity(3 * cells_.cellCount());
  for (size_t i = 0; i < velocity.size(); ++i) velocity[i] = isOpen[components.cellComponent[i / 3]] ? wind_[i % 3] : 0;
  return velocity;
}

void FlowStepper::State::start(Vector velocity) {
  const size_t n = cells_.cellCount();
  speed_ = std::max(largest(velocity), std::hypot(wind_[0], wind_[1], wind_[2]));
  flow_.time = timeStepBefore_ = 0;
  flow_.faceVelocity.assign(cells_.faceCount(), 0);
  flow_.cellPressure.assign(n, 0);
  pressureGradient_.assign(3 * n, 0);
  for (Vector& derivative : wallDerivative_) derivative.assign(boundary_.kinds.size(), 0);
  flowCells_.gradients(velocity, velocityGradients_);
  FlowStep report;
  UnsteadyFlow next = flow_;
  project(1, velocity, next, report);
  next.cellPressure.assign(n, 0);
  pressureGradient_.assign(3 * n, 0);
  flow_ = std::move(next);
  velocityBefore_ = flow_.cellVelocity;
  advectionBefore_.assign(3 * n, 0);
}

SolveOptions FlowStepper::State::solving(double tolerance) const {
  SolveOptions options;
  options.threads = options_.threads;
  options.tolerance = tolerance;
  options.maxIterations = options_.maxIterations;
  options.corrections = options_.corrections;
  options.balance = true;
  return options;
}

FlowStep FlowStepper::State::step() {
  FlowStep report;
  const double dt = report.timeStep = chooseTimeStep();
  report.courant = dt * outflowRate();
  if (!(dt > 0 && std::isfinite(dt) && std::isfinite(1 / dt))) {
    report.status = SolveStatus::breakdown;
    return report;
  }
  const Weights weights = weightsOf(timeStepBefore_ > 0 ? dt / timeStepBefore_ : 0);
  const double rate = weights.own / dt;
  flowCells_.gradients(flow_.cellVelocity, velocityGradients_);
  Vector carried = advection(), velocity(carried.size());
  for (size_t i = 0; i < velocity.size(); ++i) {
    const double past = (weights.last * flow_.cellVelocity[i] - weights.beforeLast * velocityBefore_[i]) / dt;
    velocity[i] = (past + (1 + weights.ratio) * carried[i] - weights.ratio * advectionBefore_[i] - pressureGradient_[i]) / rate;
  }
  UnsteadyFlow next = flow_;
  report.status = SolveStatus::breakdown;
  if (options_.viscosity > 0 && !addViscosity(rate, velocity, report)) return report;
  for (size_t i = 0; i < velocity.size(); ++i) velocity[i] += pressureGradient_[i] / rate;
  if (!project(rate, velocity, next, report)) return report;
  next.time += dt;
  velocityBefore_ = std::move(flow_.cellVelocity);
  advectionBefore_ = std::move(carried);
  timeStepBefore_ = dt;
  flow_ = std::move(next);
  return report;
}

/// Automatic steps keep their length while they can, since another one needs other systems.
double FlowStepper::State::chooseTimeStep() const {
  constexpr double kReserve = 0.85, kTooShort = 0.6;
  if (options_.timeStep > 0) return options_.timeStep;
  const double longest = options_.courant / outflowRate();
  const bool isKept = timeStepBefore_ <= longest && timeStepBefore_ >= kTooShort * longest;
  return isKept ? timeStepBefore_ : kReserve * longest;
}

/// The largest part of what a cell holds that flows out of it per time.
double FlowStepper::State::outflowRate() const {
  Vector outflow(cells_.cellCount());
  for (size_t h = 0; h < cells_.faceCells.size(); ++h) {
    const double flux = (h % 2 == 0 ? 1 : -1) * flow_.faceVelocity[h / 2] * cells_.faceArea[h / 2];
    if (flux > 0 && cells_.faceCells[h] >= 0) outflow[size_t(cells_.faceCells[h])] += flux;
  }
  double rate = 0;
  for (size_t c = 0; c < outflow.size(); ++c) {
    if (cells_.cellVolume[c] > 0) rate = std::max(rate, outflow[c] / cells_.cellVolume[c]);
  }
  return rate;
}

/// 3 per cell: what is carried in, per volume and time.
Vector FlowStepper::State::advection() const {
  Vector result(3 * cells_.cellCount());
  physics::addAdvection(cells_, flowCells_, flow_, velocityGradients_, result);
  const std::vector<uint32_t>& halfFaces = boundary_.boundary.halfFaces;
  for (size_t b = 0; b < halfFaces.size(); ++b) {
    const uint32_t h = halfFaces[b];
    const double out = (h % 2 == 0 ? 1 : -1) * flow_.faceVelocity[h / 2] * cells_.faceArea[h / 2];
    if (boundary_.kinds[b] == physics::FlowBoundary::Kind::surface || out == 0) continue;
    const size_t cell = size_t(cells_.faceCells[h]);
    const bool isInflow = boundary_.kinds[b] == physics::FlowBoundary::Kind::inflow;
    const double* value = out > 0 ? &flow_.cellVelocity[3 * cell] : isInflow ? &boundary_.inflow[3 * b] : wind_.data();
    for (size_t d = 0; d < 3; ++d) result[3 * cell + d] -= out * value[d];
  }
  for (size_t i = 0; i < result.size(); ++i) result[i] = cells_.cellVolume[i / 3] > 0 ? result[i] / cells_.cellVolume[i / 3] : 0;
  return result;
}

/// Replaces v by the u that solves rate u - viscosity div grad u = rate v.
bool FlowStepper::State::addViscosity(double rate, Vector& velocity, FlowStep& report) {
  constexpr double kTolerance = 1e-8;
  const size_t n = cells_.cellCount();
  const double mass = rate / options_.viscosity;
  if (mass != viscousRate_) {
    viscosity_.clear();
    for (size_t d = 0; d < 3; ++d) {
      PoissonProblem problem;
      problem.boundary = boundary_.ofVelocity(cells_, d);
      problem.dualPoints = DualPoints::centroids;
      problem.mass.assign(n, mass);
      viscosity_.emplace_back(cells_, std::move(problem), options_.threads);
    }
    viscousRate_ = mass;
  }
  Vector source(n), start(n);
  std::array<Vector, 3> derivative;
  for (size_t d = 0; d < 3; ++d) {
    for (size_t c = 0; c < n; ++c) source[c] = -mass * velocity[3 * c + d], start[c] = flow_.cellVelocity[3 * c + d];
    if (!areFinite(source)) return false;
    Solution solution = viscosity_[d].solve({source, boundary_.velocities(d), start}, solving(kTolerance));
    report.status = isSolved(solution.status) ? SolveStatus::converged : solution.status;
    report.iterations += solution.iterations();
    if (!isSolved(solution.status)) return false;
    for (size_t c = 0; c < n; ++c) velocity[3 * c + d] = solution.phi[c];
    derivative[d] = std::move(solution.boundaryDerivative);
  }
  wallDerivative_ = std::move(derivative);
  return true;
}

/// Per face: the velocities between cells, and those on the boundary.
Vector FlowStepper::State::predictedFluxes(const Vector& velocity) const {
  Vector result(cells_.faceCount());
  for (const physics::FlowFace& face : flowCells_.faces())
    result[face.face] = flowCells_.normalVelocity(face, velocity, velocityGradients_);
  const std::vector<uint32_t>& halfFaces = boundary_.boundary.halfFaces;
  for (size_t b = 0; b < halfFaces.size(); ++b) {
    const uint32_t h = halfFaces[b], cell = uint32_t(cells_.faceCells[h]);
    const double sign = h % 2 == 0 ? 1 : -1;
    if (boundary_.kinds[b] == physics::FlowBoundary::Kind::inflow) result[h / 2] = sign * boundary_.boundary.value[b];
    if (boundary_.kinds[b] != physics::FlowBoundary::Kind::outlet) continue;
    for (size_t d = 0; d < 3; ++d) result[h / 2] += velocity[3 * cell + d] * cells_.faceNormal[3 * (h / 2) + d];
  }
  return result;
}

/// Per cell: what flows out of it.
Vector FlowStepper::State::outflows(const Vector& faceVelocity) const {
  Vector result(cells_.cellCount());
  for (size_t h = 0; h < cells_.faceCells.size(); ++h) {
    const double flux = (h % 2 == 0 ? 1 : -1) * faceVelocity[h / 2] * cells_.faceArea[h / 2];
    if (cells_.faceCells[h] >= 0) result[size_t(cells_.faceCells[h])] += flux;
  }
  return result;
}

/// Finds the pressure that makes the velocity free of divergence: rate u = rate velocity - grad pressure. Changes the velocity to u.
bool FlowStepper::State::project(double rate, Vector& velocity, UnsteadyFlow& next, FlowStep& report) {
  next.faceVelocity = predictedFluxes(velocity);
  Vector source = outflows(next.faceVelocity), values(boundary_.kinds.size());
  double square = 0;
  for (double& s : source) s *= rate, square += s * s;
  // Nothing flows through the surface, because the pressure rises towards it as it did in the last step.
  for (size_t b = 0; b < values.size(); ++b) {
    if (boundary_.kinds[b] != physics::FlowBoundary::Kind::surface) continue;
    const uint32_t h = boundary_.boundary.halfFaces[b], cell = uint32_t(cells_.faceCells[h]);
    for (size_t d = 0; d < 3; ++d)
      values[b] += (h % 2 == 0 ? 1 : -1) * pressureGradient_[3 * cell + d] * cells_.faceNormal[3 * (h / 2) + d];
    source[cell] += values[b] * cells_.faceArea[h / 2];
  }
  for (size_t c = 0; c < source.size(); ++c) source[c] = cells_.cellVolume[c] > 0 ? source[c] / cells_.cellVolume[c] : 0;
  if (!areFinite(source) || !areFinite(values) || !std::isfinite(square)) return false;
  constexpr double kLeast = 1e-13;
  const double most = options_.tolerance * speed_ * area_;
  SolveOptions options = solving(square > 0 ? std::max(kLeast, most * rate / std::sqrt(square)) : 1);
  const bool isFirst = timeStepBefore_ == 0;  // so that no pressure is known
  if (isFirst) options.corrections = SolveOptions().corrections;
  const Solution solution = pressure_.solve({source, values, isFirst ? Vector() : flow_.cellPressure}, options);
  report.status = isSolved(solution.status) ? SolveStatus::converged : solution.status;
  report.iterations += solution.iterations();
  if (!isSolved(solution.status)) return false;
  for (const physics::FlowFace& face : flowCells_.faces()) next.faceVelocity[face.face] -= solution.faceDerivative[face.face] / rate;
  Vector outlet;
  for (size_t i = 0; i < boundary_.outlets.size(); ++i) {
    const uint32_t h = boundary_.outlets[i];
    outlet.push_back(solution.boundaryDerivative[boundary_.outletsAt[i]]);
    next.faceVelocity[h / 2] -= (h % 2 == 0 ? 1 : -1) * outlet.back() / rate;
  }
  flowCells_.vectors(solution.faceDerivative, outlet, pressureGradient_);
  for (size_t i = 0; i < velocity.size(); ++i) velocity[i] -= pressureGradient_[i] / rate;
  next.cellVelocity = velocity;
  next.cellPressure = solution.phi;
  report.divergence = largest(outflows(next.faceVelocity)) / (speed_ > 0 ? speed_ * area_ : 1);
  return true;
}

std::vector<SurfaceForce> FlowStepper::State::forces(std::span<const uint32_t> faceGroup, const std::array<double, 3>& centre) const {
  std::vector<SurfaceForce> forces(1);
  for (size_t b = 0; b < boundary_.kinds.size(); ++b) {
    if (boundary_.kinds[b] != physics::FlowBoundary::Kind::surface) continue;
    const uint32_t h = boundary_.boundary.halfFaces[b], f = h / 2, cell = uint32_t(cells_.faceCells[h]);
    const size_t group = faceGroup.empty() ? 0 : faceGroup[f];
    if (group >= forces.size()) forces.resize(group + 1);
    double pressure = flow_.cellPressure[cell], arm[3], force[3];
    for (size_t d = 0; d < 3; ++d) {
      pressure += pressureGradient_[3 * cell + d] * (cells_.faceCentroid[3 * f + d] - cells_.cellCentroid[3 * cell + d]);
      arm[d] = cells_.faceCentroid[3 * f + d] - centre[d];
    }
    for (size_t d = 0; d < 3; ++d) {
      const double pushed = (h % 2 == 0 ? 1 : -1) * pressure * cells_.faceArea[f] * cells_.faceNormal[3 * f + d],
                   dragged = -options_.viscosity * wallDerivative_[d][b] * cells_.faceArea[f];
      forces[group].pressure[d] += pushed;
      forces[group].viscous[d] += dragged;
      force[d] = pushed + dragged;
    }
    for (size_t d = 0; d < 3; ++d) {
      const size_t e = (d + 1) % 3, g = (d + 2) % 3;
      forces[group].moment[d] += arm[e] * force[g] - arm[g] * force[e];
    }
  }
  return forces;
}

}  // namespace mandoline
