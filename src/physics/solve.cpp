#include <algorithm>
#include <cmath>

#include "mandoline/poisson.h"
#include "mesh/run_call.h"
#include "physics/multigrid.h"
#include "physics/poisson_problem.h"

namespace mandoline {
namespace {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Symmetric, so that columns are rows.
void multiply(const SparseMatrix& matrix, const Vector& x, Vector& result) {
  const int *offsets = matrix.outerIndexPtr(), *columns = matrix.innerIndexPtr();
  const double* values = matrix.valuePtr();
  for (size_t i = 0; i < x.size(); ++i) {
    double sum = 0;
    for (int e = offsets[i]; e < offsets[i + 1]; ++e) sum += values[e] * x[size_t(columns[e])];
    result[i] = sum;
  }
}

class Solver {
 public:
  Solver(const CellComplex& cells, const PoissonProblem& problem, const SolveOptions& options, detail::Monitor& monitor)
      : cells_(cells), problem_(problem), options_(options), monitor_(monitor), system_(poissonSystem(cells, problem)) {}

  Solution run() {
    monitor_.beginStage("levels", 0);
    result_.phi.resize(cells_.cellCount());
    components_ = cellComponents(cells_);
    held_ = physics::heldComponents(cells_, problem_.boundary, components_);
    if (!balance()) return std::move(result_);
    Vector held(cells_.cellCount());
    const Vector coefficients = physics::dirichletCoefficients(cells_, problem_);
    for (size_t b = 0; b < coefficients.size(); ++b) held[size_t(cells_.faceCells[problem_.boundary.halfFaces[b]])] += coefficients[b];
    physics::Multigrid multigrid(cells_, physics::dualEdges(cells_, problem_.dualPoints), std::move(held));
    monitor_.beginStage("iterations", 1);
    iterate(multigrid);
    fixConstants();
    return std::move(result_);
  }

 private:
  /// Takes what is in excess out of the right side; false if that is too much.
  bool balance() {
    const size_t n = components_.count;
    Vector excess(n), absolute(n), volume(n);
    double all = 0;
    const auto component = [&](size_t c) { return components_.cellComponent[c]; };
    const auto add = [&](size_t r, double value) { absolute[r] += std::fabs(value), all += std::fabs(value); };
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      excess[component(c)] += system_.rhs[c];
      volume[component(c)] += cells_.cellVolume[c];
      if (!problem_.source.empty()) add(component(c), problem_.source[c]);
    }
    for (size_t b = 0; b < problem_.boundary.halfFaces.size(); ++b) {
      const uint32_t h = problem_.boundary.halfFaces[b];
      add(component(size_t(cells_.faceCells[h])), problem_.boundary.value[b] * cells_.faceArea[h / 2]);
    }
    for (size_t r = 0; r < n; ++r) {
      if (held_[r]) {
        excess[r] = 0;
      } else if (!options_.balance && !(std::fabs(excess[r]) <= 1e-9 * absolute[r] + 1e-15 * all)) {
        result_.status = SolveStatus::incompatible;
        result_.component = int64_t(r), result_.excess = excess[r];
        return false;
      }
    }
    Vector before(n), after(n);  // squares
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      const uint32_t r = component(c);
      double& value = system_.rhs[c];
      before[r] += value * value;
      if (excess[r] != 0 && volume[r] > 0) value -= excess[r] * (cells_.cellVolume[c] / volume[r]);
      after[r] += value * value;
    }
    for (size_t c = 0; c < cells_.cellCount(); ++c) {  // of what was in excess all but for rounding, nothing is left to solve
      if (after[component(c)] < 1e-24 * before[component(c)]) system_.rhs[c] = 0;
    }
    return true;
  }

  void iterate(physics::Multigrid& multigrid) {
    const size_t n = cells_.cellCount();
    Vector r = std::move(system_.rhs), z(n), p(n), ap(n);
    const double norm = std::sqrt(dot(r, r));
    result_.residuals = {norm > 0 ? 1.0 : 0.0};
    double rz = 1;
    while (result_.residuals.back() > options_.tolerance) {
      if (int64_t(result_.iterations()) >= options_.maxIterations) {
        result_.status = SolveStatus::iterationLimit;
        return;
      }
      monitor_.report(progress(), 1000);
      multigrid.apply(r, z);
      const double newRz = dot(r, z), beta = result_.iterations() == 0 ? 0 : newRz / rz;
      rz = newRz;
      for (size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
      multiply(system_.matrix, p, ap);
      const double alpha = rz / dot(p, ap);
      if (!(alpha > 0 && std::isfinite(alpha))) {
        result_.status = SolveStatus::breakdown;
        return;
      }
      for (size_t i = 0; i < n; ++i) result_.phi[i] += alpha * p[i], r[i] -= alpha * ap[i];
      result_.residuals.push_back(std::sqrt(dot(r, r)) / norm);
    }
  }

  /// In thousandths: residuals fall by a factor per iteration.
  size_t progress() const {
    const double share = std::log(result_.residuals.back()) / std::log(options_.tolerance);
    return share > 0 ? size_t(1000 * std::min(share, 1.0)) : 0;
  }

  void fixConstants() {
    const bool pinned = options_.freeConstant == FreeConstant::pinned;
    Vector sum(components_.count), weight(components_.count);
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      const uint32_t r = components_.cellComponent[c];
      const double w = !pinned ? cells_.cellVolume[c] : weight[r] == 0 ? 1 : 0;
      sum[r] += w * result_.phi[c], weight[r] += w;
    }
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      const uint32_t r = components_.cellComponent[c];
      if (!held_[r] && weight[r] > 0) result_.phi[c] -= sum[r] / weight[r];
    }
  }

  const CellComplex& cells_;
  const PoissonProblem& problem_;
  const SolveOptions& options_;
  detail::Monitor& monitor_;
  PoissonSystem system_;
  CellComponents components_;
  std::vector<char> held_;  // per component
  Solution result_;
};

}  // namespace

Solution solvePoisson(const CellComplex& cells, const PoissonProblem& problem, const SolveOptions& options) {
  if (!(options.tolerance > 0)) throw CallError({Status::badOption, -1, -1, "The tolerance has to be positive."});
  if (options.maxIterations < 0) throw CallError({Status::badOption, -1, -1, "The number of iterations can't be negative."});
  return detail::runCall("solution", [&] {
    detail::Monitor monitor(options, 2);
    return Solver(cells, problem, options, monitor).run();
  });
}

}  // namespace mandoline
