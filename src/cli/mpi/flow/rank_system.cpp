#include "cli/mpi/flow/rank_system.h"

#include <cmath>
#include <numeric>

namespace mandoline::cli {
namespace {

double square(double x) { return x * x; }

}  // namespace

template <class Value>
double RankSystem::sum(const Value& value) {
  double all = 0;
  for (const uint32_t c : own_) all += value(c);
  return comm_.reduce(all, MPI_SUM);
}

/// Per component, over the cells of all processes.
template <class Value>
RankSystem::Vector RankSystem::sums(const Value& value) {
  Vector all(components_.count);
  for (const uint32_t c : own_) all[components_.cellComponent[c]] += value(c);
  comm_.reduce(all, MPI_SUM);
  return all;
}

RankSystem::RankSystem(detail::Communicator& comm, const RankComplex& complex, const Halo& halo, const CellComponents& components,
                       const PoissonProblem& problem)
    : comm_(comm), complex_(complex), halo_(halo), components_(components) {
  comm.together("flow", [&] {
    for (uint32_t c = 0; c < complex.cells.cellCount(); ++c) {
      if (isOwn(c)) own_.push_back(c);
    }
    PoissonSystem system = poissonSystem(complex.cells, problem);
    matrix_ = std::move(system.matrix);
    rhs = std::move(system.rhs);
    phi.assign(rhs.size(), 0);
    added_.assign(rhs.size(), 0);
    system_.emplace(matrix_, added_);
  });
  isActive_ = sums([&](uint32_t c) { return std::fabs(rhs[c]); });
}

void RankSystem::balance() {
  const Vector volumes = sums([&](uint32_t c) { return complex_.cells.cellVolume[c]; });
  constexpr int kPasses = 3;  // each leaves a rounding error of the excess that it subtracts
  for (int pass = 0; pass < kPasses; ++pass) {
    const Vector excess = sums([&](uint32_t c) { return rhs[c]; });
    for (const uint32_t c : own_) {
      const uint32_t r = components_.cellComponent[c];
      if (isActive_[r] > 0 && volumes[r] > 0) rhs[c] -= excess[r] * (complex_.cells.cellVolume[c] / volumes[r]);
    }
  }
}

bool RankSystem::takeNorm() {
  norm_ = std::sqrt(sum([&](uint32_t c) { return square(rhs[c]); }));
  return norm_ > 0;
}

double RankSystem::residual() {
  return std::sqrt(sum([&](uint32_t c) { return square(rhs[c] - system_->row(phi, c)); })) / norm_;
}

/// PETSc's own residual drifts away from that of phi, which is computed from differences.
SolveStatus RankSystem::solve(double goal, const std::function<void()>& onIteration, Vector& residuals) {
  constexpr double kTolerance = 1e-10, kPart = 1e-9;
  constexpr int kMostPasses = 8, kMostIterations = 500;
  if (!solver_) solver_.emplace(comm_.handle(), rows(), onIteration);
  Vector r(own_.size()), step, best = phi;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    for (size_t i = 0; i < own_.size(); ++i) r[i] = rhs[own_[i]] - system_->row(phi, own_[i]);
    iterations_ += solver_->solve(r, kPart, kMostIterations, step);
    for (size_t i = 0; i < own_.size(); ++i) phi[own_[i]] += step[i];
    halo_.update(phi);
    sweep();
    const double found = residual();
    const bool isBetter = found < residuals.back();
    if (!isBetter) break;
    best = phi;
    const bool isSlow = !(found < residuals.back() / 2);
    residuals.push_back(found);
    if (isSlow || found <= goal) break;
  }
  phi = best;
  return residuals.back() <= kTolerance ? SolveStatus::converged : SolveStatus::iterationLimit;
}

void RankSystem::setMeans() {
  const Vector volumes = sums([&](uint32_t c) { return complex_.cells.cellVolume[c]; });
  const Vector means = sums([&](uint32_t c) { return complex_.cells.cellVolume[c] * phi[c]; });
  for (size_t c = 0; c < phi.size(); ++c) {
    const uint32_t r = components_.cellComponent[c];
    if (volumes[r] > 0) phi[c] -= means[r] / volumes[r];
  }
}

/// Rows of cells that nothing flows through say that phi is 0 there.
RankRows RankSystem::rows() {
  RankRows result;
  const std::vector<uint64_t> counts = comm_.gatherAll(uint64_t(own_.size()));
  result.all = int64_t(std::accumulate(counts.begin(), counts.end(), uint64_t(0)));
  std::vector<int64_t> rowOf(phi.size(), 0);
  int64_t next = int64_t(std::accumulate(counts.begin(), counts.begin() + comm_.rank(), uint64_t(0)));
  for (const uint32_t c : own_) rowOf[c] = next++;
  halo_.update(rowOf);
  std::vector<int32_t> vectorOf(components_.count, -1);
  for (uint32_t r = 0; r < components_.count; ++r) {
    if (isActive_[r] > 0) vectorOf[r] = result.nullCount++;
  }
  result.rowOffsets.push_back(0);
  for (const uint32_t c : own_) {
    result.nullVectors.push_back(vectorOf[components_.cellComponent[c]]);
    for (auto e = size_t(matrix_.rowOffsets[c]); e < size_t(matrix_.rowOffsets[c + 1]); ++e) {
      const size_t column = size_t(matrix_.entryColumns[e]);
      if (result.nullVectors.back() < 0 && column != c) continue;
      result.columns.push_back(rowOf[column]);
      result.values.push_back(result.nullVectors.back() < 0 ? 1 : matrix_.entryValues[e]);
    }
    if (result.nullVectors.back() < 0 && int64_t(result.columns.size()) == result.rowOffsets.back()) {
      result.columns.push_back(rowOf[c]);
      result.values.push_back(1);
    }
    result.rowOffsets.push_back(int64_t(result.columns.size()));
  }
  return result;
}

/// Gauss-Seidel, forwards and backwards: the smallest cells hardly show in a residual; this adjusts them to their neighbours.
void RankSystem::sweep() {
  for (size_t k = 0; k < 2 * own_.size(); ++k) {
    const size_t c = own_[k < own_.size() ? k : 2 * own_.size() - 1 - k];
    double diagonal = 0, sum = rhs[c];
    for (auto e = size_t(matrix_.rowOffsets[c]); e < size_t(matrix_.rowOffsets[c + 1]); ++e) {
      const auto j = size_t(matrix_.entryColumns[e]);
      if (j == c) continue;
      diagonal -= matrix_.entryValues[e];
      sum -= matrix_.entryValues[e] * (phi[j] - phi[c]);
    }
    if (diagonal > 0 && isActive_[components_.cellComponent[c]] > 0) phi[c] += sum / diagonal;
  }
  halo_.update(phi);
}

}  // namespace mandoline::cli
