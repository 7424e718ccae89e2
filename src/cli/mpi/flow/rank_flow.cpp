#include "cli/mpi/flow/rank_flow.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "cli/mpi/flow/rank_system.h"
#include "cli/mpi/flow/rank_wind.h"
#include "operators/measure/vector.h"
#include "operators/require_cut_mesh.h"
#include "physics/cell_edges.h"
#include "physics/cell_velocities.h"
#include "physics/correction_passes.h"
#include "physics/derivatives.h"
#include "physics/far_field.h"

namespace mandoline::cli {
namespace {

using Vector = std::vector<double>;

/// Solves for phi, with corrections and in the far field, as solveFlow() does it, but each pass solves as well as the last.
class RankSolver {
 public:
  RankSolver(detail::Communicator& comm, const RankComplex& complex, const Halo& halo, const RankWind& wind, const RankFlowOptions& options)
      : comm_(comm),
        cells_(complex.cells),
        options_(options),
        problem_(problemOf(wind)),
        system_(comm, complex, halo, wind.components, problem_) {
    comm.together("flow", [&] { terms_ = physics::boundaryTerms(cells_, problem_); });
    system_.balance();
  }

  void solve() {
    const bool flows = system_.takeNorm();
    if (!flow_.residuals.empty()) flow_.residuals.pop_back();
    flow_.residuals.push_back(flows ? system_.residual() : 0);
    if (flows) {
      iterate();
      if (options_.corrections > 0 && flow_.status == SolveStatus::converged) correct();
    }
    system_.setMeans();
  }

  void solveFarField(const physics::FarField& farField) {
    using Next = physics::FarFieldPasses::Next;
    physics::FarFieldPasses passes(farField, problem_.boundary.value);
    solve();
    while (flow_.status == SolveStatus::converged) {
      const Next next = passes.add(withFaceVelocities(), problem_.boundary.value);
      if (next == Next::limit) flow_.status = SolveStatus::iterationLimit;
      if (next != Next::pass) break;
      solveNext();
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
    result.iterations = system_.iterations();
    result.flow = std::move(flow_);
    result.flow.phi = std::move(system_.phi);
    return result;
  }
  /// That of the last pass.
  const PoissonProblem& problem() const { return problem_; }

 private:
  static constexpr double kGoal = 1e-14;

  static PoissonProblem problemOf(const RankWind& wind) {
    PoissonProblem problem;
    problem.boundary = wind.boundary;
    return problem;
  }

  void iterate() { flow_.status = system_.solve(kGoal, options_.onIteration, flow_.residuals); }

  void correct() {
    const Vector rhs = system_.rhs, plain = system_.phi;
    const std::vector<double> residuals = flow_.residuals;
    detail::Monitor unheard(1);
    differentiate();
    comm_.together("flow", [&] {
      if (!fitter_) fitter_.emplace(differentiator_->fitter(unheard));
    });
    /// Each face counts in one process.
    const auto product = [&](const Vector& a, const Vector& b) {
      double sum = 0;
      for (size_t i = 0; i < a.size(); ++i) {
        const uint32_t f = corrected_[i];
        if (system_.isOwn(uint32_t(cells_.faceCells[2 * size_t(f)]))) sum += a[i] * b[i] * cells_.faceArea[f];
      }
      return comm_.reduce(sum, MPI_SUM);
    };
    physics::CorrectionPasses passes(corrected_.size(), 0x1p10 * kGoal * kGoal * squareOfPlain(), false);
    for (int pass = 0; pass < options_.corrections; ++pass) {
      Vector found;
      comm_.together("flow", [&] { found = differentiator_->corrections(*fitter_, system_.phi, unheard); });
      if (!passes.add(std::move(found), product)) return;
      corrections_ = passes.next();
      system_.rhs = rhs;
      differentiator_->addFlows(corrections_, system_.rhs);
      flow_.residuals.push_back(system_.residual());
      if (flow_.residuals.back() > kGoal) iterate();
      if (flow_.status != SolveStatus::converged) break;
    }
    if (flow_.status == SolveStatus::converged) return;
    corrections_.clear();  // better a solution of first order than none
    system_.rhs = rhs, system_.phi = plain;
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
      flow.phi = system_.phi;
      flow.faceVelocity = differentiator_->plain(system_.phi, 1);
      flow.faceVelocity.resize(cells_.faceCount());
      for (size_t i = 0; i < corrections_.size(); ++i) flow.faceVelocity[corrected_[i]] += corrections_[i];
      physics::setOnBoundary(problem_.boundary, flow.faceVelocity);
    });
    return flow;
  }

  /// With other values of the boundary; goes on from phi.
  void solveNext() {
    comm_.together("flow", [&] { system_.rhs = physics::rightSide(cells_, problem_.boundary, terms_, {{}, problem_.boundary.value, {}}); });
    system_.balance();
    corrections_.clear();
    solve();
  }

  double squareOfPlain() {
    const Vector plain = differentiator_->plain(system_.phi, 1);
    double sum = 0;
    for (size_t f = 0; f < cells_.faceCount(); ++f) {
      const int32_t cell = cells_.faceCells[2 * f];
      if (cell >= 0 && system_.isOwn(uint32_t(cell))) sum += plain[f] * plain[f] * cells_.faceArea[f];
    }
    return comm_.reduce(sum, MPI_SUM);
  }

  detail::Communicator& comm_;
  const CellComplex& cells_;
  const RankFlowOptions& options_;
  PoissonProblem problem_;
  RankSystem system_;
  std::vector<physics::BoundaryTerm> terms_;
  physics::DualEdges dual_;
  detail::Csr<uint32_t> edges_;
  std::optional<physics::Differentiator> differentiator_;  // once it is needed
  std::optional<physics::CellFitter> fitter_;              // likewise
  Flow flow_;
  Vector corrections_;
  std::vector<uint32_t> corrected_;  // faces
  std::vector<physics::FaceCorrection> onSides_;
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

void solveInFarField(detail::Communicator& comm, const RankComplex& complex, const RankWind& through, RankSolver& solver) {
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
    solver.solveFarField(farField);
  else
    solver.solve();
}

}  // namespace

RankFlow solveRankFlow(detail::Communicator& comm, const RankComplex& complex, const std::array<double, 3>& wind,
                       const RankFlowOptions& options) {
  const double length = measuring::length(wind);
  std::array<double, 3> unit{};
  for (size_t d = 0; d < 3 && length > 0; ++d) unit[d] = wind[d] / length;
  const Halo halo(comm, complex);
  const RankWind through = rankWind(comm, complex, halo, unit);
  RankSolver solver(comm, complex, halo, through, options);
  if (options.farField)
    solveInFarField(comm, complex, through, solver);
  else
    solver.solve();
  RankFlow result = solver.take();
  result.imbalance = imbalanceOf(comm, complex, solver.problem().boundary, result);
  result.flow.wind = wind;
  result.flow.throttled = through.throttled;
  comm.together("flow", [&] {
    detail::Monitor unheard(1);
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
