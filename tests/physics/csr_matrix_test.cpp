// The system that a PoissonSolver solves, as plain arrays: what they hold, and that other solvers find the same phi with them.
#include "mandoline/csr_matrix.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include "physics/sparse.h"
#include "refusal.h"
#include "waves.h"

using namespace mandoline;

namespace {

constexpr Cells kCells[] = {{}, {.isCoarsened = true}, {.isMerged = true}, {true, true}};

/// Values on the surface, Robin conditions on one side of the grid, and a derivative given elsewhere.
PoissonProblem mixedProblem(const CellComplex& cells) {
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  setBoundary(problem.boundary, cells, FaceTag::surface, Condition::dirichlet, 0.7);
  setBoundary(problem.boundary, cells, FaceTag::yMin, Condition::neumann, -0.4);
  setRobin(problem.boundary, cells, FaceTag::xMax, 2, 0.3);
  for (size_t c = 0; c < cells.cellCount(); ++c) problem.source.push_back(waves(&cells.cellCentroid[3 * c]));
  return problem;
}

PoissonData dataOf(const PoissonProblem& problem) { return {problem.source, problem.boundary.value, {}}; }

Solution plainSolution(PoissonSolver& solver, const PoissonData& data) {
  SolveOptions options;
  options.tolerance = 1e-13;
  options.corrections = 0;
  Solution solution = solver.solve(data, options);
  REQUIRE(solution.status == SolveStatus::converged);
  return solution;
}

/// A problem, whose system others solve, too, and its phi.
struct Solved {
  Solved(const Cells& way, int n) : cells(ballCells(way, n)), problem(mixedProblem(cells)), solver(cells, problem) {}

  CellComplex cells;
  PoissonProblem problem;
  PoissonSolver solver;
  EigenRows rows{solver.matrix()};
  std::vector<double> rhs = solver.rightSide(dataOf(problem)), phi = plainSolution(solver, dataOf(problem)).phi;
};

bool areSame(const CsrMatrix& a, const CsrMatrix& b) {
  return a.columns == b.columns && a.rowOffsets == b.rowOffsets && a.entryColumns == b.entryColumns && a.entryValues == b.entryValues;
}

}  // namespace

TEST_CASE("csr matrix: of a solver it is square and symmetric, columns ascend, and offsets end with the entries", "[csr]") {
  for (const Cells& way : kCells) {
    const CellComplex cells = ballCells(way, 16);
    const CsrMatrix matrix = PoissonSolver(cells, mixedProblem(cells)).matrix();
    REQUIRE(matrix.rows() == cells.cellCount());
    REQUIRE(matrix.columns == cells.cellCount());
    REQUIRE(matrix.rowOffsets.front() == 0);
    REQUIRE(matrix.rowOffsets.back() == int64_t(matrix.entryCount()));
    REQUIRE(matrix.entryColumns.size() == matrix.entryCount());
    for (size_t r = 0; r < matrix.rows(); ++r) {
      for (int64_t e = matrix.rowOffsets[r] + 1; e < matrix.rowOffsets[r + 1]; ++e)
        REQUIRE(matrix.entryColumns[size_t(e) - 1] < matrix.entryColumns[size_t(e)]);
    }
    const SparseMatrix copy = eigenOf(matrix), transposed = copy.transpose();
    CHECK(isZero(SparseMatrix(copy - transposed).pruned(1, 1e-15)));
  }
}

TEST_CASE("csr matrix: a solver has the system of poissonSystem(), to the bit", "[csr]") {
  const CellComplex cells = ballCells({true, true}, 12);
  PoissonProblem problem = mixedProblem(cells);
  for (const bool isHeld : {true, false}) {
    if (!isHeld) problem.boundary = boundaryOf(cells);
    const PoissonSystem system = poissonSystem(cells, problem);
    const PoissonSolver solver(cells, problem);
    CHECK(areSame(solver.matrix(), system.matrix));
    CHECK(areSame(solver.nullSpace(), system.nullSpace));
    CHECK(system.nullSpace.columns == (isHeld ? 0 : 2));
    CHECK(solver.rightSide(dataOf(problem)) == system.rhs);
  }
}

TEST_CASE("csr matrix: its product with the solution is the right side", "[csr]") {
  for (const Cells& way : kCells) {
    const Solved solved(way, 16);
    const auto rhs = vectorOf(solved.rhs);
    CHECK((solved.rows.map() * vectorOf(solved.phi) - rhs).norm() <= 2e-13 * rhs.norm());
  }
}

TEST_CASE("csr matrix: factors and conjugate gradients of Eigen find the solver's phi", "[csr]") {
  for (const Cells& way : kCells) {
    const Solved solved(way, 12);
    const auto rhs = vectorOf(solved.rhs), phi = vectorOf(solved.phi);
    const Eigen::SimplicialLDLT<SparseMatrix> factors(SparseMatrix(solved.rows.map()));
    REQUIRE(factors.info() == Eigen::Success);
    CHECK(largest(factors.solve(rhs) - phi) <= 1e-11 * largest(phi));
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::Lower | Eigen::Upper> gradients(solved.rows.map());
    gradients.setTolerance(1e-13);
    CHECK(largest(gradients.solve(rhs) - phi) <= 1e-11 * largest(phi));
  }
}

TEST_CASE("csr matrix: constants of components where phi is held nowhere are its null space", "[csr]") {
  const CellComplex cells = ballCells({.isCoarsened = true}, 12);
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  setBoundary(problem.boundary, cells, FaceTag::xMin, Condition::dirichlet, 1);
  const PoissonSolver solver(cells, problem);  // phi is held outside of the ball
  const CsrMatrix nullSpace = solver.nullSpace();
  REQUIRE(nullSpace.columns == 1);
  for (size_t c = 0; c < cells.cellCount(); ++c)
    CHECK((nullSpace.rowOffsets[c + 1] > nullSpace.rowOffsets[c]) == (cells.cellRegion[c] != cells.cellRegion.back()));
  CHECK(isZero(SparseMatrix(eigenOf(solver.matrix()) * eigenOf(nullSpace)).pruned(1, 1e-14)));
}

TEST_CASE("csr matrix: Eigen reads columns and values where they are", "[csr]") {
  const CellComplex cells = ballCells({}, 6);
  const PoissonSolver solver(cells, mixedProblem(cells));
  const EigenRows rows(solver.matrix());
  CHECK(rows.map().valuePtr() == solver.matrix().entryValues.data());
  CHECK(rows.map().innerIndexPtr() == solver.matrix().entryColumns.data());
  const CsrMatrix empty;
  CHECK(EigenRows(empty).map().rows() == 0);
}

TEST_CASE("csr matrix: more entries than Eigen counts with 32 bits are refused", "[csr]") {
  const auto viewOf = [](int64_t entries) {
    CsrMatrix matrix;
    matrix.rowOffsets = {0, entries};
    return refusal([&] { EigenRows{matrix}; });
  };
  CHECK(viewOf(int64_t(1) << 31).first == Status::badArgument);
  CHECK(viewOf((int64_t(1) << 32) + 1).first == Status::badArgument);
}

TEST_CASE("csr matrix: entries in one place are added, rows without any are empty", "[csr]") {
  const physics::Triplets entries = {{2, 1, 1.5}, {0, 3, 2}, {2, 0, -1}, {2, 1, 0.25}, {0, 3, 4}};
  const CsrMatrix matrix = physics::assembleRows(4, 5, entries);
  CHECK(matrix.columns == 5);
  CHECK(matrix.rowOffsets == std::vector<int64_t>{0, 1, 1, 3, 3});
  CHECK(matrix.entryColumns == std::vector<int32_t>{3, 0, 1});
  CHECK(matrix.entryValues == std::vector<double>{6, -1, 1.75});
}
