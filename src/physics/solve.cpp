#include <algorithm>
#include <cmath>

#include "physics/correction_passes.h"
#include "physics/node_loops.h"
#include "physics/poisson_setup.h"
#include "physics/unresolved_cells.h"

namespace mandoline::physics {
namespace {

using Vector = std::vector<double>;

class Solver {
 public:
  Solver(PoissonSetup& setup, const PoissonData& data, const SolveOptions& options, detail::Monitor& monitor)
      : setup_(setup), cells_(setup.cells), data_(data), options_(options), monitor_(monitor), team_(monitor.threads()) {}

  Solution run() {
    PoissonProblem& problem = setup_.problem;
    problem.source.assign(data_.source.begin(), data_.source.end());
    problem.boundary.value.assign(data_.boundaryValue.begin(), data_.boundaryValue.end());
    problem.boundary.value.resize(setup_.terms.size());
    rhs_ = rightSide(cells_, problem.boundary, setup_.terms, data_);
    Vector given = absolutes();
    exponent_ = scaleDown(given);
    balance(given);
    for (double& excess : result_.excess) excess = std::ldexp(excess, exponent_);
    start();
    solve();
    setDerivatives();
    fixConstants();
    findUnresolved();
    for (Vector* values : {&result_.phi, &result_.faceDerivative, &result_.boundaryDerivative}) scaleBy(exponent_, *values);
    if (!areFinite(result_.phi, team_)) result_.status = SolveStatus::breakdown;
    if (result_.status == SolveStatus::converged && !result_.unresolved.empty()) result_.status = SolveStatus::unresolved;
    if (isSolved(result_.status) && !result_.incompatible.empty()) result_.status = SolveStatus::incompatible;
    return std::move(result_);
  }

 private:
  /// Divides what is given and the right side by a power of two, so that squares of it are neither too large nor too small for doubles.
  /// Returns the exponent.
  int scaleDown(Vector& given) {
    int exponent = 0;
    std::frexp(given.empty() ? 0 : *std::max_element(given.begin(), given.end()), &exponent);
    for (Vector* values : {&given, &rhs_, &setup_.problem.source, &setup_.problem.boundary.value}) scaleBy(-exponent, *values);
    return exponent;
  }

  /// Subtracts the excess from the right side; where it is too large, the component is left with nothing to solve. `given`: absolutes().
  void balance(const Vector& given) {
    const Vector excess = excesses(), absolute = sumsOf([&](size_t c) { return given[c]; });
    double all = 0;
    for (const double sum : absolute) all += sum;
    for (size_t r = 0; r < absolute.size(); ++r) {
      if (setup_.held[r] || options_.balance || std::fabs(excess[r]) <= 1e-9 * absolute[r] + 1e-15 * all) continue;
      result_.incompatible.push_back(uint32_t(r));
      result_.excess.push_back(excess[r]);
    }
    // A rounding error left in the sum would make waves in cells that only the tiniest faces connect.
    forCells([&](size_t c) {
      if (isIncompatible(component(c)) || std::fabs(rhs_[c]) <= kRounding * given[c]) rhs_[c] = 0;
    });
    const auto squares = [&] { return sumsOf([&](size_t c) { return rhs_[c] * rhs_[c]; }); };
    const Vector before = squares(), volume = sumsOf([&](size_t c) { return cells_.cellVolume[c]; });
    constexpr int kPasses = 3;  // each leaves a rounding error of the excess that it subtracts
    for (int pass = 0; pass < kPasses; ++pass) takeAway(excesses(), volume);
    const Vector after = squares();
    forCells([&](size_t c) {  // where only rounding is left beside the excess, there is nothing to solve
      if (after[component(c)] < 1e-24 * before[component(c)]) rhs_[c] = 0;
    });
  }

  /// f(cell) for all.
  template <class F>
  void forCells(const F& f) const {
    forBlocks(cells_.cellCount(), team_, [&](size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) f(c);
    });
  }
  /// Per component.
  template <class F>
  Vector sumsOf(const F& f) const {
    return setup_.runs.sums(team_, [&](size_t begin, size_t end) {
      double sum = 0;
      for (size_t c = begin; c < end; ++c) sum += f(c);
      return sum;
    });
  }

  bool isIncompatible(uint32_t r) const { return std::binary_search(result_.incompatible.begin(), result_.incompatible.end(), r); }

  /// Per cell: the terms of the right side, each without its sign.
  Vector absolutes() const {
    Vector sums(cells_.cellCount());
    const Vector& source = setup_.problem.source;
    const Boundary& boundary = setup_.problem.boundary;
    if (!source.empty()) forCells([&](size_t c) { sums[c] = std::fabs(source[c] * cells_.cellVolume[c]); });
    for (size_t b = 0; b < setup_.terms.size(); ++b)
      sums[size_t(cells_.faceCells[boundary.halfFaces[b]])] += std::fabs(boundary.value[b] * setup_.terms[b].perValue);
    return sums;
  }

  /// Per component in which phi is held nowhere the sum of the right side; 0 for others.
  Vector excesses() const {
    Vector sums = sumsOf([&](size_t c) { return rhs_[c]; });
    for (size_t r = 0; r < sums.size(); ++r) {
      if (setup_.held[r]) sums[r] = 0;
    }
    return sums;
  }

  /// Evenly by volume.
  void takeAway(const Vector& excess, const Vector& volume) {
    forCells([&](size_t c) {
      const uint32_t r = component(c);
      if (excess[r] != 0 && volume[r] > 0) rhs_[c] -= excess[r] * (cells_.cellVolume[c] / volume[r]);
    });
  }

  uint32_t component(size_t c) const { return setup_.components.cellComponent[c]; }

  /// What iterations start from: 0, unless what is given is nearer to the solution.
  void start() {
    result_.phi.assign(data_.start.begin(), data_.start.end());
    scaleBy(-exponent_, result_.phi);
    for (size_t c = 0; c < result_.phi.size(); ++c) {
      if (isIncompatible(component(c))) result_.phi[c] = 0;
    }
    norm_ = std::sqrt(dot(rhs_, rhs_));
    result_.residuals = {norm_ > 0 ? 1.0 : 0.0};
    isWarm_ = !result_.phi.empty() && norm_ > 0 && residual() <= 1;
    if (!isWarm_) result_.phi.assign(cells_.cellCount(), 0);
  }

  void solve() {
    const Vector rhs = rhs_;
    const bool isCorrected = options_.corrections > 0 && norm_ > 0;
    if (!isWarm_ || !isCorrected) iterate(options_.tolerance);
    if (!isCorrected || result_.status != SolveStatus::converged) return;
    correct();
    if (!isWarm_ && corrections_.empty()) return;
    iterate(options_.tolerance);
    if (result_.status != SolveStatus::breakdown) return;
    corrections_.clear();  // better a solution of first order than none
    rhs_ = rhs;
    result_.phi.assign(result_.phi.size(), 0);
    iterate(options_.tolerance);
  }

  /// Adds what plain derivatives lack to the right side, again and again: the matrix keeps the plain ones.
  void correct() {
    const Vector rhs = rhs_;
    detail::Monitor unheard(monitor_.threads());
    const Differentiator& differentiator = setup_.differentiator;
    if (!setup_.fitter) setup_.fitter.emplace(differentiator.fitter(unheard));
    const double enough = 0x1p10 * options_.tolerance * options_.tolerance * differentiator.squareOfPlain(result_.phi, threads());
    CorrectionPasses passes(differentiator.corrected().size(), enough, isWarm_);
    for (int pass = 0; pass < options_.corrections; ++pass) {
      Vector found = differentiator.corrections(*setup_.fitter, result_.phi, unheard);
      for (size_t i = 0; i < found.size(); ++i) {
        if (found[i] != 0 && isIncompatible(component(differentiator.cellOf(differentiator.corrected()[i])))) found[i] = 0;
      }
      if (!passes.add(std::move(found), [&](const Vector& a, const Vector& b) { return differentiator.product(a, b); })) return;
      corrections_ = passes.next();
      rhs_ = rhs;
      differentiator.addFlows(corrections_, rhs_);
      if (isWarm_ && pass + 1 == options_.corrections) return;
      iterate(std::max(options_.tolerance, kLoose * residual()));
      if (result_.status != SolveStatus::converged) return;
    }
  }

  void setDerivatives() {
    Vector derivatives = setup_.differentiator.plain(result_.phi, threads());
    for (size_t i = 0; i < corrections_.size(); ++i) derivatives[setup_.differentiator.corrected()[i]] += corrections_[i];
    const auto boundary = derivatives.begin() + ptrdiff_t(cells_.faceCount());
    result_.boundaryDerivative.assign(boundary, derivatives.end());
    derivatives.erase(boundary, derivatives.end());
    result_.faceDerivative = std::move(derivatives);
  }

  void scaleBy(int exponent, Vector& values) const {
    if (exponent == 0) return;
    const double factor = std::ldexp(1.0, exponent);
    forBlocks(values.size(), team_, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) values[i] = std::isnormal(factor) ? values[i] * factor : std::ldexp(values[i], exponent);
    });
  }

  double sumOver(detail::FunctionRef<double(size_t, size_t)> f) const { return sumOfBlocks(rhs_.size(), team_, f); }
  double dot(const Vector& a, const Vector& b) const {
    return sumOver([&](size_t begin, size_t end) {
      double sum = 0;
      for (size_t i = begin; i < end; ++i) sum += a[i] * b[i];
      return sum;
    });
  }
  unsigned threads() const { return monitor_.threads(); }

  double residual() {
    r_.resize(rhs_.size());
    return updateResidual(r_);
  }

  /// Sets r to the residual, and returns its size.
  double updateResidual(Vector& r) {
    const double square = sumOver([&](size_t begin, size_t end) {
      double sum = 0;
      for (size_t i = begin; i < end; ++i) r[i] = rhs_[i] - setup_.system.row(result_.phi, i), sum += r[i] * r[i];
      return sum;
    });
    return result_.residuals.back() = norm_ > 0 ? std::sqrt(square) / norm_ : 0;
  }

  /// Conjugate gradients update the residual instead of computing it, and where phi has large steps the two drift apart. So the computed
  /// one decides, and while that helps they are started again from the phi that they have found.
  void iterate(double tolerance) {
    Vector& r = r_;
    r.resize(rhs_.size());
    for (double before = updateResidual(r); !(before <= tolerance);) {  // also if it is no number
      const SolveStatus status = conjugateGradients(r, std::min(tolerance, before / 10));
      setup_.system.sweep(setup_.order, rhs_, result_.phi, team_);
      const double now = updateResidual(r);
      if (now <= tolerance) return;
      if (status == SolveStatus::iterationLimit || !(now < before / 2)) {
        result_.status = status == SolveStatus::iterationLimit ? status : SolveStatus::breakdown;
        return;
      }
      before = now;
    }
  }

  /// Starts from phi with the residual r and changes both, until the residual as updated is at most `goal`.
  SolveStatus conjugateGradients(Vector& r, double goal) {
    const size_t n = r.size();
    Vector &z = z_, &p = p_, &ap = ap_;
    for (Vector* values : {&z, &ap}) values->resize(n);
    p.assign(n, 0);
    for (double rz = 0; !(result_.residuals.back() <= goal);) {
      if (int64_t(result_.iterations()) >= options_.maxIterations) return SolveStatus::iterationLimit;
      progress_ = std::max(progress_, progress());
      monitor_.report(progress_, 1000);
      setup_.multigrid.apply(r, z, team_);
      const double newRz = setup_.means.takeOut(r, z, team_), beta = rz == 0 ? 0 : newRz / rz;
      rz = newRz;
      forBlocks(n, team_, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) p[i] = z[i] + beta * p[i];
      });
      const double alpha = rz / sumOver([&](size_t begin, size_t end) {
                             double sum = 0;
                             for (size_t i = begin; i < end; ++i) ap[i] = setup_.system.row(p, i), sum += p[i] * ap[i];
                             return sum;
                           });
      if (!(alpha > 0 && std::isfinite(alpha))) return SolveStatus::breakdown;
      const double square = sumOver([&](size_t begin, size_t end) {
        double sum = 0;
        for (size_t i = begin; i < end; ++i) {
          result_.phi[i] += alpha * p[i];
          r[i] -= alpha * ap[i];
          sum += r[i] * r[i];
        }
        return sum;
      });
      result_.residuals.push_back(std::sqrt(square) / norm_);
    }
    return SolveStatus::converged;
  }

  /// In thousandths: residuals fall by a factor per iteration.
  size_t progress() const {
    const double share = std::log(result_.residuals.back()) / std::log(options_.tolerance);
    return share > 0 ? size_t(1000 * std::min(share, 1.0)) : 0;
  }

  void fixConstants() {
    const bool pinned = options_.freeConstant == FreeConstant::pinned;
    Vector shift = sumsOf([&](size_t c) { return pinned ? 0 : cells_.cellVolume[c] * result_.phi[c]; });
    const Vector volume = sumsOf([&](size_t c) { return cells_.cellVolume[c]; });
    for (size_t r = 0; r < shift.size(); ++r) shift[r] = volume[r] > 0 ? shift[r] / volume[r] : 0;
    for (size_t c = cells_.cellCount(); pinned && c-- > 0;) shift[component(c)] = result_.phi[c];  // of the first cell
    forCells([&](size_t c) {
      if (!setup_.held[component(c)]) result_.phi[c] -= shift[component(c)];
    });
  }

  void findUnresolved() {
    if (result_.status != SolveStatus::converged || result_.phi.empty()) return;
    const auto [low, high] = std::minmax_element(result_.phi.begin(), result_.phi.end());
    result_.unresolved = unresolvedCells(setup_, kUnresolved * (*high - *low), team_);
  }

  /// So wrong, relative to the range of phi, it is not resolved.
  static constexpr double kUnresolved = 1e-6;
  /// A sum smaller than this, relative to the sum of the magnitudes of its terms, is rounding.
  static constexpr double kRounding = 1e-15;
  /// So loosely is solved what more corrections follow.
  static constexpr double kLoose = 1e-2;

  PoissonSetup& setup_;
  const CellComplex& cells_;
  const PoissonData& data_;
  const SolveOptions& options_;
  detail::Monitor& monitor_;
  const detail::Team team_;
  Vector rhs_;
  double norm_ = 0;      // of the right side
  bool isWarm_ = false;  // whether phi to start from is given
  size_t progress_ = 0;
  int exponent_ = 0;       // phi and the right side are divided by 2 to it
  Vector corrections_;     // of derivatives
  Vector r_, z_, p_, ap_;  // room for conjugate gradients
  Solution result_;
};

}  // namespace

Solution solve(PoissonSetup& setup, const PoissonData& data, const SolveOptions& options, detail::Monitor& monitor) {
  return Solver(setup, data, options, monitor).run();
}

}  // namespace mandoline::physics
