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

/// The system's matrix, multiplied by differences of x: except for what Dirichlet conditions add, each row sums to zero. So rounding of a
/// large constant in x does not drown the rest.
class Operator {
 public:
  Operator(const SparseMatrix& matrix, const Vector& held) : matrix_(matrix), held_(held) {}

  double row(const Vector& x, size_t i) const {
    double sum = held_[i] * x[i];
    forEachOther(i, [&](size_t j, double value) { sum += value * (x[j] - x[i]); });
    return sum;
  }
  void multiply(const Vector& x, Vector& result) const {
    for (size_t i = 0; i < x.size(); ++i) result[i] = row(x, i);
  }
  /// Gauss-Seidel, forwards and backwards. The smallest cells hardly show in a residual; this adjusts them to their neighbours.
  void sweep(const Vector& rhs, Vector& x) const {
    for (size_t k = 0; k < 2 * x.size(); ++k) {
      const size_t i = k < x.size() ? k : 2 * x.size() - 1 - k;
      double diagonal = held_[i];
      forEachOther(i, [&](size_t, double value) { diagonal -= value; });
      if (diagonal > 0) x[i] += (rhs[i] - row(x, i)) / diagonal;
    }
  }

 private:
  /// Symmetric, so that columns are rows.
  template <class F>
  void forEachOther(size_t i, const F& f) const {
    const int *offsets = matrix_.outerIndexPtr(), *columns = matrix_.innerIndexPtr();
    for (int e = offsets[i]; e < offsets[i + 1]; ++e) {
      if (size_t(columns[e]) != i) f(size_t(columns[e]), matrix_.valuePtr()[e]);
    }
  }

  const SparseMatrix& matrix_;
  const Vector& held_;
};

class Solver {
 public:
  Solver(const CellComplex& cells, const PoissonProblem& problem, const SolveOptions& options, detail::Monitor& monitor)
      : cells_(cells), problem_(problem), options_(options), monitor_(monitor), system_(poissonSystem(cells, problem)) {}

  Solution run() {
    monitor_.beginStage("levels", 0);
    result_.phi.resize(cells_.cellCount());
    components_ = cellComponents(cells_);
    held_ = physics::heldComponents(cells_, problem_.boundary, components_);
    const Vector coefficients = physics::dirichletCoefficients(cells_, problem_);
    Vector given = absolutes(coefficients);
    const int exponent = scaleDown(given);
    balance(given);
    for (double& excess : result_.excess) excess = std::ldexp(excess, exponent);
    Vector held(cells_.cellCount());
    for (size_t b = 0; b < coefficients.size(); ++b) held[size_t(cells_.faceCells[problem_.boundary.halfFaces[b]])] += coefficients[b];
    physics::Multigrid multigrid(cells_, physics::dualEdges(cells_, problem_.dualPoints), held);
    const Operator matrix(system_.matrix, held);
    monitor_.beginStage("iterations", 1);
    iterate(matrix, multigrid);
    fixConstants();
    for (double& phi : result_.phi) phi = std::ldexp(phi, exponent);
    if (!std::all_of(result_.phi.begin(), result_.phi.end(), [](double phi) { return std::isfinite(phi); })) {
      result_.status = SolveStatus::breakdown;
    }
    if (result_.status == SolveStatus::converged && !result_.incompatible.empty()) result_.status = SolveStatus::incompatible;
    return std::move(result_);
  }

 private:
  /// Divides the right side by a power of two, so that squares of it are neither too large nor too small for doubles. Returns the exponent.
  int scaleDown(Vector& given) {
    int exponent = 0;
    std::frexp(given.empty() ? 0 : *std::max_element(given.begin(), given.end()), &exponent);
    for (double& sum : given) sum = std::ldexp(sum, -exponent);
    for (double& value : system_.rhs) value = std::ldexp(value, -exponent);
    return exponent;
  }

  /// Subtracts the excess from the right side; where it is too large, the component is left with nothing to solve. `given`: absolutes().
  void balance(const Vector& given) {
    const size_t n = components_.count;
    Vector excess = excesses(), absolute(n);
    double all = 0;
    for (size_t c = 0; c < given.size(); ++c) absolute[component(c)] += given[c], all += given[c];
    for (size_t r = 0; r < n; ++r) {
      if (held_[r] || options_.balance || std::fabs(excess[r]) <= 1e-9 * absolute[r] + 1e-15 * all) continue;
      result_.incompatible.push_back(uint32_t(r));
      result_.excess.push_back(excess[r]);
    }
    for (size_t c = 0; c < given.size(); ++c) {
      if (isIncompatible(component(c))) system_.rhs[c] = 0;
    }
    // A rounding error left in the sum would make waves in cells that only the tiniest faces connect.
    for (size_t c = 0; c < given.size(); ++c) {
      if (std::fabs(system_.rhs[c]) <= kRounding * given[c]) system_.rhs[c] = 0;
    }
    const Vector before = squares();
    constexpr int kPasses = 3;  // each leaves a rounding error of the excess that it subtracts
    for (int pass = 0; pass < kPasses; ++pass) takeAway(excesses());
    const Vector after = squares();
    for (size_t c = 0; c < given.size(); ++c) {  // where only rounding is left beside the excess, there is nothing to solve
      if (after[component(c)] < 1e-24 * before[component(c)]) system_.rhs[c] = 0;
    }
  }

  bool isIncompatible(uint32_t r) const { return std::binary_search(result_.incompatible.begin(), result_.incompatible.end(), r); }

  /// Per cell: the terms of the right side, each without its sign.
  Vector absolutes(const Vector& dirichletCoefficients) const {
    Vector sums(cells_.cellCount());
    for (size_t c = 0; c < problem_.source.size(); ++c) sums[c] = std::fabs(problem_.source[c] * cells_.cellVolume[c]);
    const Boundary& boundary = problem_.boundary;
    for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
      const uint32_t h = boundary.halfFaces[b];
      const bool isNeumann = boundary.condition[b] == Condition::neumann;
      sums[size_t(cells_.faceCells[h])] += std::fabs(boundary.value[b] * (isNeumann ? cells_.faceArea[h / 2] : dirichletCoefficients[b]));
    }
    return sums;
  }

  /// Per component without a Dirichlet condition the sum of the right side; 0 for others.
  Vector excesses() const {
    Vector sums(components_.count);
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      if (!held_[component(c)]) sums[component(c)] += system_.rhs[c];
    }
    return sums;
  }

  /// Evenly by volume.
  void takeAway(const Vector& excess) {
    Vector volume(components_.count);
    for (size_t c = 0; c < cells_.cellCount(); ++c) volume[component(c)] += cells_.cellVolume[c];
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      const uint32_t r = component(c);
      if (excess[r] != 0 && volume[r] > 0) system_.rhs[c] -= excess[r] * (cells_.cellVolume[c] / volume[r]);
    }
  }

  /// Per component, of the right side.
  Vector squares() const {
    Vector sums(components_.count);
    for (size_t c = 0; c < cells_.cellCount(); ++c) sums[component(c)] += system_.rhs[c] * system_.rhs[c];
    return sums;
  }

  uint32_t component(size_t c) const { return components_.cellComponent[c]; }

  /// Conjugate gradients update the residual instead of computing it, and where phi has large steps the two drift apart. So the computed
  /// one decides, and while that helps they are started again from the phi that they have found.
  void iterate(const Operator& matrix, physics::Multigrid& multigrid) {
    Vector r = system_.rhs;
    norm_ = std::sqrt(dot(r, r));
    result_.residuals = {norm_ > 0 ? 1.0 : 0.0};
    while (!(result_.residuals.back() <= options_.tolerance)) {  // also if it is no number
      const double before = result_.residuals.back();
      const SolveStatus status = conjugateGradients(matrix, multigrid, r, std::min(options_.tolerance, before / 10));
      matrix.sweep(system_.rhs, result_.phi);
      matrix.multiply(result_.phi, r);
      for (size_t i = 0; i < r.size(); ++i) r[i] = system_.rhs[i] - r[i];
      const double now = result_.residuals.back() = std::sqrt(dot(r, r)) / norm_;
      if (now <= options_.tolerance) return;
      if (status == SolveStatus::iterationLimit || !(now < before / 2)) {
        result_.status = status == SolveStatus::iterationLimit ? status : SolveStatus::breakdown;
        return;
      }
    }
  }

  /// Starts from phi with the residual r and changes both, until the residual as updated is at most `goal`.
  SolveStatus conjugateGradients(const Operator& matrix, physics::Multigrid& multigrid, Vector& r, double goal) {
    const size_t n = r.size();
    Vector z(n), p(n), ap(n);
    for (double rz = 0; !(result_.residuals.back() <= goal);) {
      if (int64_t(result_.iterations()) >= options_.maxIterations) return SolveStatus::iterationLimit;
      monitor_.report(progress(), 1000);
      multigrid.apply(r, z);
      takeMeansOut(z);
      const double newRz = dot(r, z), beta = rz == 0 ? 0 : newRz / rz;
      rz = newRz;
      for (size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
      matrix.multiply(p, ap);
      const double alpha = rz / dot(p, ap);
      if (!(alpha > 0 && std::isfinite(alpha))) return SolveStatus::breakdown;
      for (size_t i = 0; i < n; ++i) result_.phi[i] += alpha * p[i], r[i] -= alpha * ap[i];
      result_.residuals.push_back(std::sqrt(dot(r, r)) / norm_);
    }
    return SolveStatus::converged;
  }

  /// Removes the constants from x: they are no progress, and the rounding of large ones would drown it.
  void takeMeansOut(Vector& z) const {
    Vector sum(components_.count), volume(components_.count);
    for (size_t c = 0; c < z.size(); ++c) sum[component(c)] += z[c] * cells_.cellVolume[c], volume[component(c)] += cells_.cellVolume[c];
    for (size_t c = 0; c < z.size(); ++c) {
      if (!held_[component(c)] && volume[component(c)] > 0) z[c] -= sum[component(c)] / volume[component(c)];
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

  /// A sum smaller than this, relative to the sum of the magnitudes of its terms, is rounding.
  static constexpr double kRounding = 1e-15;
  const CellComplex& cells_;
  const PoissonProblem& problem_;
  const SolveOptions& options_;
  detail::Monitor& monitor_;
  PoissonSystem system_;
  CellComponents components_;
  std::vector<char> held_;  // per component
  double norm_ = 0;         // of the right side
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
