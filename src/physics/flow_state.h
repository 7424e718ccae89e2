// A flow in time, and all that its steps use again.
#pragma once

#include "physics/flow_boundary.h"
#include "physics/flow_cells.h"

namespace mandoline {

class FlowStepper::State {
 public:
  State(const CellComplex& cells, const std::array<double, 3>& wind, const FlowStepperOptions& options);

  void start(std::vector<double> cellVelocity);
  FlowStep step();
  const UnsteadyFlow& flow() const { return flow_; }
  std::vector<SurfaceForce> forces(std::span<const uint32_t> faceGroup, const std::array<double, 3>& centre) const;
  const CellComplex& cells() const { return cells_; }

 private:
  /// Of a step of BDF2 after another one: (own u - last u' + beforeLast u'') / timeStep is the derivative, and advection is that of
  /// u' times 1 + ratio less that of u'' times ratio.
  struct Weights {
    double own, last, beforeLast, ratio;
  };
  static Weights weightsOf(double ratio) { return {(1 + 2 * ratio) / (1 + ratio), 1 + ratio, ratio * ratio / (1 + ratio), ratio}; }

  double chooseTimeStep() const;
  double outflowRate() const;
  std::vector<double> windAtStart() const;
  std::vector<double> advection() const;
  bool addViscosity(double rate, std::vector<double>& velocity, FlowStep& report);
  bool project(double rate, std::vector<double>& velocity, UnsteadyFlow& next, FlowStep& report);
  std::vector<double> predictedFluxes(const std::vector<double>& velocity) const;
  std::vector<double> outflows(const std::vector<double>& faceVelocity) const;
  SolveOptions solving(double tolerance) const;

  const CellComplex& cells_;
  std::array<double, 3> wind_;
  FlowStepperOptions options_;
  physics::FlowBoundary boundary_;
  physics::FlowCells flowCells_;
  PoissonSolver pressure_;
  std::vector<PoissonSolver> viscosity_;  // per component, if there is viscosity
  double viscousRate_ = 0;                // that they were made for
  double speed_ = 0, area_ = 0;           // that divergence is relative to

  UnsteadyFlow flow_;
  std::vector<double> pressureGradient_;                  // 3 per cell
  std::vector<double> velocityGradients_;                 // 9 per cell
  std::array<std::vector<double>, 3> wallDerivative_;     // per component and half-face of the boundary: of the velocity, outwards
  std::vector<double> velocityBefore_, advectionBefore_;  // of the step before
  double timeStepBefore_ = 0;
};

}  // namespace mandoline
