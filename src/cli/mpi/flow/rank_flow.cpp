#include "cli/mpi/flow/rank_flow.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "cli/mpi/flow/petsc_solver.h"
#include "cli/mpi/flow/rank_wind.h"
#include "operators/measure/vector.h"
#include "physics/cell_velocities.h"
#include "physics/dual_edges.h"
#include "physics/system_matrix.h"

namespace mandoline::cli {
namespace {

using Vector = std::vector<double>;

/// The system of the whole, of which each process has the rows of its own cells.
class RankSolver {
 public:
  RankSolver(detail::Communicator& comm, const RankComplex& complex, const Halo& halo, const RankWind& wind)
      : comm_(comm), cells_(complex.cells), halo_(halo), components_(wind.components) {
    for (uint32_t c = 0; c < cells_.cellCount(); ++c) {
      if (complex.cellRanks[c] == comm.rank()) own_.push_back(c);
    }
    comm.together("flow", [&] {
      PoissonProblem problem;
      problem.boundary = wind.boundary;
      system_ = poissonSystem(cells_, problem);
    });
    phi_.assign(cells_.cellCount(), 0);
    added_.assign(cells_.cellCount(), 0);
    balance();
  }

  Flow run(const std::function<void()>& onIteration) {
    Flow flow;
    const double norm = std::sqrt(sum([&](uint32_t c) { return square(system_.rhs[c]); }));
    flow.residuals.push_back(norm > 0 ? 1 : 0);
    if (norm > 0) iterate(norm, onIteration, flow);
    setMeans();
    flow.phi = phi_;
    return flow;
  }

  int iterations() const { return iterations_; }
  const std::vector<uint32_t>& own() const { return own_; }

 private:
  static double square(double x) { return x * x; }

  template <class Value>
  double sum(const Value& value) {
    double all = 0;
    for (const uint32_t c : own_) all += value(c);
    return comm_.reduce(all, MPI_SUM);
  }

  /// Per component, over the cells of all processes.
  template <class Value>
  Vector sums(const Value& value) {
    Vector all(components_.count);
    for (const uint32_t c : own_) all[components_.cellComponent[c]] += value(c);
    comm_.reduce(all, MPI_SUM);
    return all;
  }

  /// Takes away what rounding leaves of the sum of the right side of each component, evenly by volume.
  void balance() {
    const Vector volumes = sums([&](uint32_t c) { return cells_.cellVolume[c]; });
    constexpr int kPasses = 3;  // each leaves a rounding error of the excess that it subtracts
    isActive_ = sums([&](uint32_t c) { return std::fabs(system_.rhs[c]); });
    for (int pass = 0; pass < kPasses; ++pass) {
      const Vector excess = sums([&](uint32_t c) { return system_.rhs[c]; });
      for (const uint32_t c : own_) {
        const uint32_t r = components_.cellComponent[c];
        if (isActive_[r] > 0 && volumes[r] > 0) system_.rhs[c] -= excess[r] * (cells_.cellVolume[c] / volumes[r]);
      }
    }
  }

  /// Rows of cells that nothing flows through say that phi is 0 there.
  RankRows rows() {
    RankRows result;
    const std::vector<uint64_t> counts = comm_.gatherAll(uint64_t(own_.size()));
    result.all = int64_t(std::accumulate(counts.begin(), counts.end(), uint64_t(0)));
    std::vector<int64_t> rowOf(cells_.cellCount(), 0);
    int64_t next = int64_t(std::accumulate(counts.begin(), counts.begin() + comm_.rank(), uint64_t(0)));
    for (const uint32_t c : own_) rowOf[c] = next++;
    halo_.update(rowOf);
    std::vector<int32_t> vectorOf(components_.count, -1);
    for (uint32_t r = 0; r < components_.count; ++r) {
      if (isActive_[r] > 0) vectorOf[r] = result.nullCount++;
    }
    const CsrMatrix& matrix = system_.matrix;
    result.rowOffsets.push_back(0);
    for (const uint32_t c : own_) {
      result.nullVectors.push_back(vectorOf[components_.cellComponent[c]]);
      for (auto e = size_t(matrix.rowOffsets[c]); e < size_t(matrix.rowOffsets[c + 1]); ++e) {
        const size_t column = size_t(matrix.entryColumns[e]);
        if (result.nullVectors.back() < 0 && column != c) continue;
        result.columns.push_back(rowOf[column]);
        result.values.push_back(result.nullVectors.back() < 0 ? 1 : matrix.entryValues[e]);
      }
      if (result.nullVectors.back() < 0 && int64_t(result.columns.size()) == result.rowOffsets.back()) {
        result.columns.push_back(rowOf[c]);
        result.values.push_back(1);
      }
      result.rowOffsets.push_back(int64_t(result.columns.size()));
    }
    return result;
  }

  /// Solves for what the residual lacks, again and again: PETSc's own residual drifts away from that of phi, which is computed from
  /// differences.
  void iterate(double norm, const std::function<void()>& onIteration, Flow& flow) {
    constexpr double kTolerance = 1e-10, kGoal = 1e-14, kPart = 1e-9;
    constexpr int kMostPasses = 8, kMostIterations = 500;
    PetscSolver solver(MPI_COMM_WORLD, rows(), onIteration);
    const physics::SystemMatrix matrix(system_.matrix, added_);
    Vector r(own_.size()), step, best = phi_;
    for (int pass = 0; pass < kMostPasses; ++pass) {
      for (size_t i = 0; i < own_.size(); ++i) r[i] = system_.rhs[own_[i]] - matrix.row(phi_, own_[i]);
      iterations_ += solver.solve(r, kPart, kMostIterations, step);
      for (size_t i = 0; i < own_.size(); ++i) phi_[own_[i]] += step[i];
      halo_.update(phi_);
      sweep();
      const double residual = std::sqrt(sum([&](uint32_t c) { return square(system_.rhs[c] - matrix.row(phi_, c)); })) / norm;
      const bool isBetter = residual < flow.residuals.back();
      if (!isBetter) break;
      best = phi_;
      const bool isSlow = !(residual < flow.residuals.back() / 2);
      flow.residuals.push_back(residual);
      if (isSlow || residual <= kGoal) break;
    }
    phi_ = best;
    flow.status = flow.residuals.back() <= kTolerance ? SolveStatus::converged : SolveStatus::iterationLimit;
  }

  /// Gauss-Seidel, forwards and backwards: the smallest cells hardly show in a residual; this adjusts them to their neighbours.
  void sweep() {
    const CsrMatrix& matrix = system_.matrix;
    for (size_t k = 0; k < 2 * own_.size(); ++k) {
      const size_t c = own_[k < own_.size() ? k : 2 * own_.size() - 1 - k];
      double diagonal = 0, sum = system_.rhs[c];
      for (auto e = size_t(matrix.rowOffsets[c]); e < size_t(matrix.rowOffsets[c + 1]); ++e) {
        const auto j = size_t(matrix.entryColumns[e]);
        if (j == c) continue;
        diagonal -= matrix.entryValues[e];
        sum -= matrix.entryValues[e] * (phi_[j] - phi_[c]);
      }
      if (diagonal > 0 && isActive_[components_.cellComponent[c]] > 0) phi_[c] += sum / diagonal;
    }
    halo_.update(phi_);
  }

  /// Phi has the mean zero by volume in each component.
  void setMeans() {
    const Vector volumes = sums([&](uint32_t c) { return cells_.cellVolume[c]; });
    const Vector means = sums([&](uint32_t c) { return cells_.cellVolume[c] * phi_[c]; });
    for (size_t c = 0; c < phi_.size(); ++c) {
      const uint32_t r = components_.cellComponent[c];
      if (volumes[r] > 0) phi_[c] -= means[r] / volumes[r];
    }
  }

  detail::Communicator& comm_;
  const CellComplex& cells_;
  const Halo& halo_;
  const CellComponents& components_;
  std::vector<uint32_t> own_;
  PoissonSystem system_;  // also of ghosts, whose rows are not complete
  Vector phi_, added_;
  Vector isActive_;  // per component: more than 0 where something flows
  int iterations_ = 0;
};

/// Of the flow through the faces of cells, of a wind of length 1.
double imbalanceOf(detail::Communicator& comm, const RankComplex& complex, const RankWind& wind, const Vector& phi) {
  const CellComplex& cells = complex.cells;
  Vector sums(cells.cellCount());
  double largest = 0;
  const auto isOwn = [&](size_t c) { return complex.cellRanks[c] == comm.rank(); };
  const physics::DualEdges dual = physics::dualEdges(cells, DualPoints::centres);
  for (size_t e = 0; e < dual.edges.size(); ++e) {
    const double derivative = dual.edges[e].sign * physics::differenceAt(cells, dual, e, phi) / dual.edges[e].distance;
    for (const uint32_t f : dual.faces[e]) {
      const double flux = derivative * cells.faceArea[f];
      const auto a = size_t(cells.faceCells[2 * size_t(f)]), b = size_t(cells.faceCells[2 * size_t(f) + 1]);
      if (isOwn(a) || isOwn(b)) largest = std::max(largest, std::fabs(flux));
      sums[a] += flux, sums[b] -= flux;
    }
  }
  for (size_t b = 0; b < wind.boundary.halfFaces.size(); ++b) {
    const uint32_t h = wind.boundary.halfFaces[b];
    sums[size_t(cells.faceCells[h])] += wind.boundary.value[b] * cells.faceArea[h / 2];
  }
  double worst = 0;
  for (size_t c = 0; c < sums.size(); ++c) {
    if (isOwn(c)) worst = std::max(worst, std::fabs(sums[c]));
  }
  largest = comm.reduce(largest, MPI_MAX), worst = comm.reduce(worst, MPI_MAX);
  return largest > 0 ? worst / largest : 0;
}

}  // namespace

RankFlow solveRankFlow(detail::Communicator& comm, const RankComplex& complex, const std::array<double, 3>& wind,
                       const std::function<void()>& onIteration) {
  RankFlow result;
  const double length = measuring::length(wind);
  std::array<double, 3> unit{};
  for (size_t d = 0; d < 3 && length > 0; ++d) unit[d] = wind[d] / length;
  const Halo halo(comm, complex);
  const RankWind through = rankWind(comm, complex, halo, unit);
  RankSolver solver(comm, complex, halo, through);
  result.flow = solver.run(onIteration);
  result.iterations = solver.iterations();
  result.imbalance = imbalanceOf(comm, complex, through, result.flow.phi);
  result.flow.wind = wind;
  result.flow.throttled = through.throttled;
  comm.together("flow", [&] {
    PoissonProblem problem;
    problem.boundary = through.boundary;
    const RunOptions quiet{1, {}};
    detail::Monitor unheard(quiet, 1);
    physics::fillVelocities(complex.cells, problem, unheard, result.flow);
  });
  result.flow.cellGradient.clear();
  for (Vector* values : {&result.flow.phi, &result.flow.cellVelocity}) {
    for (double& value : *values) value *= length;
  }
  return result;
}

}  // namespace mandoline::cli
