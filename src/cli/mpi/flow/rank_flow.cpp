#include "cli/mpi/flow/rank_flow.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/parallel.h"
#include "cli/mpi/flow/petsc_solver.h"
#include "cli/mpi/flow/rank_wind.h"
#include "operators/measure/vector.h"
#include "operators/require_cut_mesh.h"
#include "physics/cell_edges.h"
#include "physics/cell_velocities.h"
#include "physics/correction_passes.h"
#include "physics/derivatives.h"
#include "physics/far_field.h"
#include "physics/system_matrix.h"

namespace mandoline::cli {
namespace {

using Vector = std::vector<double>;

/// The system of the whole, of which each process has the rows of its own cells.
class RankSolver {
 public:
  RankSolver(detail::Communicator& comm, const RankComplex& complex, const Halo& halo, const RankWind& wind)
      : comm_(comm), complex_(complex), cells_(complex.cells), halo_(halo), components_(wind.components) {
    for (uint32_t c = 0; c < cells_.cellCount(); ++c) {
      if (isOwn(c)) own_.push_back(c);
    }
    comm.together("flow", [&] {
      problem_.boundary = wind.boundary;
      system_ = poissonSystem(cells_, problem_);
      matrix_.emplace(system_.matrix, added_);
      terms_ = physics::boundaryTerms(cells_, problem_);
    });
    phi_.assign(cells_.cellCount(), 0);
    added_.assign(cells_.cellCount(), 0);
    isActive_ = sums([&](uint32_t c) { return std::fabs(system_.rhs[c]); });
    balance();
  }

  void solve(const RankFlowOptions& options) {
    norm_ = std::sqrt(sum([&](uint32_t c) { return square(system_.rhs[c]); }));
    if (!flow_.residuals.empty()) flow_.residuals.pop_back();
    flow_.residuals.push_back(norm_ > 0 ? residual() : 0);
    if (norm_ > 0) {
      if (!solver_) solver_.emplace(comm_.handle(), rows(), options.onIteration);
      iterate(kGoal);
      if (options.corrections > 0 && flow_.status == SolveStatus::converged) correct(options.corrections);
    }
    setMeans();
  }

  /// As solveFlow() does it, but each pass solves as well as the last.
  void solveFarField(const physics::FarField& farField, const RankFlowOptions& options) {
    using Next = physics::FarFieldPasses::Next;
    physics::FarFieldPasses passes(farField, problem_.boundary.value);
    solve(options);
    while (flow_.status == SolveStatus::converged) {
      const Next next = passes.add(withFaceVelocities(), problem_.boundary.value);
      if (next == Next::limit) flow_.status = SolveStatus::iterationLimit;
      if (next != Next::pass) break;
      solveNext(options);
    }
    for (size_t b = 0; b < passes.ofDipoles().size(); ++b) {
      const uint32_t h = problem_.boundary.halfFaces[b];
      const double velocity = passes.ofDipoles()[b];
      if (velocity != 0) onSides_.push_back({h / 2, h % 2 == 0 ? velocity : -velocity});
    }
  }

  RankFlow take() {
    RankFlow result;
    for (size_t i = 0; i < corrections_.size(); ++i) result.corrections.push_back({corrected_[i], corrections_[i]});
    result.onSides = std::move(onSides_);
    result.iterations = iterations_;
    result.flow = std::move(flow_);
    result.flow.phi = std::move(phi_);
    return result;
  }
  /// That of the last pass.
  const PoissonProblem& problem() const { return problem_; }

 private:
  static constexpr double kGoal = 1e-14;

  static double square(double x) { return x * x; }
  bool isOwn(uint32_t cell) const { return complex_.cellRanks[cell] == comm_.rank(); }

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

  double residual() {
    return std::sqrt(sum([&](uint32_t c) { return square(system_.rhs[c] - matrix_->row(phi_, c)); })) / norm_;
  }

  /// Solves for what the residual lacks, again and again: PETSc's own residual drifts away from that of phi, which is computed from
  /// differences.
  void iterate(double goal) {
    constexpr double kTolerance = 1e-10, kPart = 1e-9;
    constexpr int kMostPasses = 8, kMostIterations = 500;
    Vector r(own_.size()), step, best = phi_;
    for (int pass = 0; pass < kMostPasses; ++pass) {
      for (size_t i = 0; i < own_.size(); ++i) r[i] = system_.rhs[own_[i]] - matrix_->row(phi_, own_[i]);
      iterations_ += solver_->solve(r, kPart, kMostIterations, step);
      for (size_t i = 0; i < own_.size(); ++i) phi_[own_[i]] += step[i];
      halo_.update(phi_);
      sweep();
      const double found = residual();
      const bool isBetter = found < flow_.residuals.back();
      if (!isBetter) break;
      best = phi_;
      const bool isSlow = !(found < flow_.residuals.back() / 2);
      flow_.residuals.push_back(found);
      if (isSlow || found <= goal) break;
    }
    phi_ = best;
    flow_.status = flow_.residuals.back() <= kTolerance ? SolveStatus::converged : SolveStatus::iterationLimit;
  }

  /// As a solution by one process does it, but each pass solves as well as the last.
  void correct(int most) {
    const Vector rhs = system_.rhs, plain = phi_;
    const std::vector<double> residuals = flow_.residuals;
    const RunOptions quiet{1, {}};
    detail::Monitor unheard(quiet, 1);
    differentiate();
    comm_.together("flow", [&] {
      if (!fitter_) fitter_.emplace(differentiator_->fitter(unheard));
    });
    /// Each face counts in one process.
    const auto product = [&](const Vector& a, const Vector& b) {
      double sum = 0;
      for (size_t i = 0; i < a.size(); ++i) {
        const uint32_t f = corrected_[i];
        if (isOwn(uint32_t(cells_.faceCells[2 * size_t(f)]))) sum += a[i] * b[i] * cells_.faceArea[f];
      }
      return comm_.reduce(sum, MPI_SUM);
    };
    physics::CorrectionPasses passes(corrected_.size(), 0x1p10 * kGoal * kGoal * squareOfPlain(), false);
    for (int pass = 0; pass < most; ++pass) {
      Vector found;
      comm_.together("flow", [&] { found = differentiator_->corrections(*fitter_, phi_, unheard); });
      if (!passes.add(std::move(found), product)) return;
      corrections_ = passes.next();
      system_.rhs = rhs;
      differentiator_->addFlows(corrections_, system_.rhs);
      flow_.residuals.push_back(residual());
      if (flow_.residuals.back() > kGoal) iterate(kGoal);
      if (flow_.status != SolveStatus::converged) break;
    }
    if (flow_.status == SolveStatus::converged) return;
    corrections_.clear();  // better a solution of first order than none
    system_.rhs = rhs, phi_ = plain;
    flow_.residuals = residuals;
    flow_.status = SolveStatus::converged;
  }

  /// Makes what differences of phi on faces take.
  void differentiate() {
    comm_.together("flow", [&] {
      if (differentiator_) return;
      dual_ = physics::dualEdges(cells_, problem_.dualPoints);
      edges_ = physics::cellEdges(cells_, dual_, 1);
      differentiator_.emplace(physics::FitSource{cells_, dual_, edges_, problem_}, terms_, 1);
      corrected_ = differentiator_->corrected();
    });
  }

  Flow withFaceVelocities() {
    differentiate();
    Flow flow;
    comm_.together("flow", [&] {
      flow.phi = phi_;
      flow.faceVelocity = differentiator_->plain(phi_, 1);
      flow.faceVelocity.resize(cells_.faceCount());
      for (size_t i = 0; i < corrections_.size(); ++i) flow.faceVelocity[corrected_[i]] += corrections_[i];
      physics::setOnBoundary(problem_.boundary, flow.faceVelocity);
    });
    return flow;
  }

  /// With other values of the boundary; goes on from phi.
  void solveNext(const RankFlowOptions& options) {
    comm_.together("flow", [&] { system_.rhs = physics::rightSide(cells_, problem_.boundary, terms_, {{}, problem_.boundary.value, {}}); });
    balance();
    corrections_.clear();
    solve(options);
  }

  double squareOfPlain() {
    const Vector plain = differentiator_->plain(phi_, 1);
    double sum = 0;
    for (size_t f = 0; f < cells_.faceCount(); ++f) {
      const int32_t cell = cells_.faceCells[2 * f];
      if (cell >= 0 && isOwn(uint32_t(cell))) sum += plain[f] * plain[f] * cells_.faceArea[f];
    }
    return comm_.reduce(sum, MPI_SUM);
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
  const RankComplex& complex_;
  const CellComplex& cells_;
  const Halo& halo_;
  const CellComponents& components_;
  std::vector<uint32_t> own_;
  PoissonSystem system_;  // also of ghosts, whose rows are not complete
  PoissonProblem problem_;
  std::optional<physics::SystemMatrix> matrix_;
  std::optional<PetscSolver> solver_;
  std::vector<physics::BoundaryTerm> terms_;
  physics::DualEdges dual_;
  detail::Csr<uint32_t> edges_;
  std::optional<physics::Differentiator> differentiator_;  // once it is needed
  std::optional<physics::CellFitter> fitter_;              // likewise
  double norm_ = 0;                                        // of the right side without corrections
  Flow flow_;
  Vector phi_, added_, corrections_;
  std::vector<uint32_t> corrected_;  // faces
  std::vector<physics::FaceCorrection> onSides_;
  Vector isActive_;  // per component: more than 0 where something flows
  int iterations_ = 0;
};

/// Of the flow through the faces of cells, of a wind of length 1.
double imbalanceOf(detail::Communicator& comm, const RankComplex& complex, const Boundary& boundary, const RankFlow& found) {
  const CellComplex& cells = complex.cells;
  Vector sums(cells.cellCount());
  Vector added(cells.faceCount());
  for (const physics::FaceCorrection& correction : found.corrections) added[correction.face] = correction.velocity;
  double largest = 0;
  const auto isOwn = [&](size_t c) { return complex.cellRanks[c] == comm.rank(); };
  const physics::DualEdges dual = physics::dualEdges(cells, DualPoints::centres);
  for (size_t e = 0; e < dual.edges.size(); ++e) {
    const double derivative = dual.edges[e].sign * physics::differenceAt(cells, dual, e, found.flow.phi) / dual.edges[e].distance;
    for (const uint32_t f : dual.faces[e]) {
      const double flux = (derivative + added[f]) * cells.faceArea[f];
      const auto a = size_t(cells.faceCells[2 * size_t(f)]), b = size_t(cells.faceCells[2 * size_t(f) + 1]);
      if (isOwn(a) || isOwn(b)) largest = std::max(largest, std::fabs(flux));
      sums[a] += flux, sums[b] -= flux;
    }
  }
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    sums[size_t(cells.faceCells[h])] += boundary.value[b] * cells.faceArea[h / 2];
  }
  double worst = 0;
  for (size_t c = 0; c < sums.size(); ++c) {
    if (isOwn(c)) worst = std::max(worst, std::fabs(sums[c]));
  }
  largest = comm.reduce(largest, MPI_MAX), worst = comm.reduce(worst, MPI_MAX);
  return largest > 0 ? worst / largest : 0;
}

void solveInFarField(detail::Communicator& comm, const RankComplex& complex, const RankWind& through, const RankFlowOptions& options,
                     RankSolver& solver) {
  physics::FarFieldShare share;
  comm.together("flow", [&] {
    share.parts = through.parts;
    for (const int32_t rank : complex.cellRanks) share.isOwn.push_back(rank == comm.rank());
    share.sum = [&](Vector& numbers) { comm.reduce(numbers, MPI_SUM); };
    share.least = [&](Vector& numbers) { comm.reduce(numbers, MPI_MIN); };
    // Which of the whole's faces it is, no process knows.
    if (physics::wallOnSide(complex.cells, through.boundary, share))
      operators::refuse("With the far field no wall may reach a side of the box, but one does.");
  });
  const physics::FarField farField(complex.cells, through.boundary, share);
  if (farField.hasDipoles())
    solver.solveFarField(farField, options);
  else
    solver.solve(options);
}

}  // namespace

RankFlow solveRankFlow(detail::Communicator& comm, const RankComplex& complex, const std::array<double, 3>& wind,
                       const RankFlowOptions& options) {
  const double length = measuring::length(wind);
  std::array<double, 3> unit{};
  for (size_t d = 0; d < 3 && length > 0; ++d) unit[d] = wind[d] / length;
  const Halo halo(comm, complex);
  const RankWind through = rankWind(comm, complex, halo, unit);
  RankSolver solver(comm, complex, halo, through);
  if (options.farField)
    solveInFarField(comm, complex, through, options, solver);
  else
    solver.solve(options);
  RankFlow result = solver.take();
  result.imbalance = imbalanceOf(comm, complex, solver.problem().boundary, result);
  result.flow.wind = wind;
  result.flow.throttled = through.throttled;
  comm.together("flow", [&] {
    const RunOptions quiet{1, {}};
    detail::Monitor unheard(quiet, 1);
    physics::fillVelocities(complex.cells, solver.problem(), unheard, result.flow);
  });
  result.flow.cellGradient.clear();
  for (Vector* values : {&result.flow.phi, &result.flow.cellVelocity}) {
    for (double& value : *values) value *= length;
  }
  for (auto* added : {&result.corrections, &result.onSides}) {
    for (physics::FaceCorrection& correction : *added) correction.velocity *= length;
  }
  return result;
}

}  // namespace mandoline::cli
