// Heat that spreads through the cells of a complex, step by step: library mandoline::operators.
#pragma once

#include "mandoline/poisson.h"

namespace MANDOLINE_API mandoline {

/// What a HeatStepper starts from.
struct HeatProblem {
  /// Conditions, dual points, where centroids are best, the coefficient k and, if heat is lost in proportion to phi, the mass m.
  PoissonProblem problem;
  std::vector<double> phi;  ///< per cell: at time 0, at its dual point
  double timeStep = 0;
};

/// Solves d phi / dt = div k grad phi - m phi - s in implicit steps of any length: the Runge-Kutta method of two stages by Alexander
/// (1977), of second order in time and L-stable, so that what is rough is damped at once. Both stages have one matrix, which is made once.
class HeatStepper {
 public:
  /// `cells` have to outlive the stepper; `threads` as in PoissonSolver. Throws CallError as poissonSystem() does, for a phi that is not
  /// finite (element: the cell) or of another length, or for a time step that is not positive (badOption).
  HeatStepper(const CellComplex& cells, HeatProblem problem, unsigned threads = 0);

  /// One step, during which sources and boundary values are those of `problem`; setSource() and setBoundaryValue() change them from one
  /// step to the next. If a solution is neither converged nor unresolved, its status is returned and phi stays that of the step before.
  /// Throws CallError as PoissonSolver::solve() does.
  SolveStatus step(const SolveOptions& options = {});

  void setSource(std::vector<double> source) { source_ = std::move(source); }
  void setBoundaryValue(std::vector<double> values) { boundaryValue_ = std::move(values); }

  const std::vector<double>& phi() const { return phi_; }
  /// That of the second stage of the last step, with phi's derivatives on faces.
  const Solution& solution() const { return solution_; }
  double time() const { return timeStep_ * double(steps_); }

 private:
  PoissonSolver solver_;
  std::vector<double> source_, boundaryValue_, phi_;
  double timeStep_;
  size_t steps_ = 0;
  Solution solution_;
};

}  // namespace mandoline
