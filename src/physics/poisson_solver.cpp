#include "mesh/run_call.h"
#include "physics/cell_edges.h"
#include "physics/joined_cells.h"
#include "physics/poisson_setup.h"
#include "physics/sparse.h"

namespace mandoline {
namespace physics {
namespace {

PoissonProblem checked(const CellComplex& cells, PoissonProblem problem) {
  requireProblem(cells, problem);
  return problem;
}

void requireData(const CellComplex& cells, const PoissonProblem& problem, const PoissonData& data) {
  requireSources(cells, data.source);
  requireValues(problem.boundary, data.boundaryValue);
  if (!data.start.empty()) requireCellValues(cells, data.start, {"values of phi to start from", "phi", " to start from"});
}

}  // namespace

PoissonSetup::PoissonSetup(const CellComplex& cells_, PoissonProblem problem_, unsigned threads)
    : cells(cells_),
      problem(checked(cells_, std::move(problem_))),
      components(componentsOf(cells, threads)),
      held(heldComponents(cells, problem, components)),
      terms(boundaryTerms(cells, problem)),
      dual(dualEdges(cells, problem.dualPoints, problem.faceCoefficient, threads)),
      edgesOfCells(cellEdges(cells, dual, threads)),
      mass(massTerms(cells, problem)),
      added(addedTerms(heldTerms(cells, problem.boundary, terms), mass)),
      matrix(laplacianRows(cells, dual, edgesOfCells, {-1, added}, threads)),
      order(sweepOrderOf(matrix)),
      system(matrix, added),
      runs(components),
      means(cells, runs, held, threads),
      multigrid(multigridLevels(cells, {matrix, order}, heldTerms(cells, problem.boundary, terms), mass, threads)),
      differentiator({cells, dual, edgesOfCells, problem}, terms, threads) {}

Solution solveOnly(PoissonSetup& setup, const PoissonData& data, const SolveOptions& options, const char* noun) {
  return detail::runCall(noun, [&] {
    detail::Monitor monitor(options, 1);
    monitor.beginStage("iterations", 0);
    return solve(setup, data, options, monitor);
  });
}

void requireOptions(const SolveOptions& options) {
  if (!(options.tolerance > 0)) throw CallError({Status::badOption, -1, -1, "The tolerance has to be positive."});
  if (options.maxIterations < 0) throw CallError({Status::badOption, -1, -1, "The number of iterations can't be negative."});
  if (options.corrections < 0) throw CallError({Status::badOption, -1, -1, "The number of corrections can't be negative."});
}

}  // namespace physics

Solution solvePoisson(const CellComplex& cells, const PoissonProblem& problem, const SolveOptions& options) {
  physics::requireOptions(options);
  return detail::runCall("solution", [&] {
    detail::Monitor monitor(options, 2);
    monitor.beginStage("levels", 0);
    physics::PoissonSetup setup(cells, problem, monitor.threads());
    monitor.beginStage("iterations", 1);
    return physics::solve(setup, {problem.source, problem.boundary.value, {}}, options, monitor);
  });
}

struct PoissonSolver::Setup : physics::PoissonSetup {
  using PoissonSetup::PoissonSetup;
};

PoissonSolver::PoissonSolver(const CellComplex& cells, PoissonProblem problem, unsigned threads)
    : setup_(detail::runCall("solver", [&] {
        return std::make_unique<Setup>(cells, std::move(problem), detail::Monitor(RunOptions{threads, {}}, 1).threads());
      })) {}
PoissonSolver::PoissonSolver(PoissonSolver&&) noexcept = default;
PoissonSolver& PoissonSolver::operator=(PoissonSolver&&) noexcept = default;
PoissonSolver::~PoissonSolver() = default;

const CsrMatrix& PoissonSolver::matrix() const { return setup_->matrix; }

std::vector<double> PoissonSolver::rightSide(const PoissonData& data) const {
  physics::requireData(setup_->cells, setup_->problem, data);
  return physics::rightSide(setup_->cells, setup_->problem.boundary, setup_->terms, data);
}

CsrMatrix PoissonSolver::nullSpace() const { return physics::nullSpaceOf(setup_->components, setup_->held); }

Solution PoissonSolver::solve(const PoissonData& data, const SolveOptions& options) {
  physics::requireOptions(options);
  physics::requireData(setup_->cells, setup_->problem, data);
  return physics::solveOnly(*setup_, data, options, "solution");
}

}  // namespace mandoline
