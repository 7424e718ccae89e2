// Poisson's equation with a coefficient and a mass, and a solver that is used again and again.
#include <Eigen/Dense>
#include <cmath>

#include "refusal.h"
#include "waves.h"

using namespace mandoline;

namespace {

constexpr double kMass = 3;

double coefficient(const double* x) { return std::exp(x[0] / 2 - x[1] / 4); }

/// -div k grad waves + kMass * waves, with its sign changed.
double source(const double* x) {
  const double e = std::exp(x[2] / 2), k = coefficient(x);
  const double alongSlope = std::cos(x[0]) * std::cos(x[1]) * e + std::sin(x[0]) * std::sin(x[1]) * e / 2;
  return k * (-1.75 * waves(x) + alongSlope / 2) - kMass * waves(x);
}

PoissonProblem wavesProblem(const CellComplex& cells) {
  PoissonProblem problem;
  problem.dualPoints = DualPoints::centroids;
  problem.boundary = boundaryOf(cells);
  for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
    problem.boundary.condition[b] = Condition::dirichlet;
    problem.boundary.value[b] = waves(&cells.faceCentroid[3 * (problem.boundary.halfFaces[b] / 2)]);
  }
  for (size_t f = 0; f < cells.faceCount(); ++f) problem.faceCoefficient.push_back(coefficient(&cells.faceCentroid[3 * f]));
  problem.mass.assign(cells.cellCount(), kMass);
  for (size_t c = 0; c < cells.cellCount(); ++c) problem.source.push_back(source(&cells.cellCentroid[3 * c]));
  return problem;
}

/// Two layers of different k, which jumps at the plane x = 2 between cells; phi is 0 on the left and 1 on the right.
struct Layers {
  static constexpr double kLeft = 1, kRight = 50;
  CellComplex cells;
  PoissonProblem problem;

  explicit Layers(const Mesh& mesh) : cells(complexOf(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {4, 4, 4}))) {
    problem.boundary = boundaryOf(cells);
    setBoundary(problem.boundary, cells, FaceTag::xMin, Condition::dirichlet, 0);
    setBoundary(problem.boundary, cells, FaceTag::xMax, Condition::dirichlet, 1);
    for (size_t f = 0; f < cells.faceCount(); ++f) {
      const double x = cells.faceCentroid[3 * f];
      problem.faceCoefficient.push_back(x == 2 ? 2 * kLeft * kRight / (kLeft + kRight) : x < 2 ? kLeft : kRight);
    }
  }

  static double flux() { return 1 / (2 / kLeft + 2 / kRight); }
  static double phi(double x) { return x < 2 ? x * flux() / kLeft : 1 - (4 - x) * flux() / kRight; }
};

bool areSame(const Solution& a, const Solution& b) {
  return a.phi == b.phi && a.faceDerivative == b.faceDerivative && a.boundaryDerivative == b.boundaryDerivative &&
         a.residuals == b.residuals && a.status == b.status;
}

}  // namespace

TEST_CASE("poisson solver: a coefficient and a mass, of second order on merged cells", "[poisson]") {
  std::array<std::array<double, 2>, 2> errors;
  for (const int i : {0, 1}) {
    const CellComplex cells = ballCells({.isMerged = true}, 12 << i);
    const PoissonProblem problem = wavesProblem(cells);
    const Solution solution = solvePoisson(cells, problem);
    REQUIRE(solution.status == SolveStatus::converged);
    errors[size_t(i)] = wavesErrors(cells, problem, solution);
    SolveOptions plain;
    plain.corrections = 0;
    const auto plainErrors = wavesErrors(cells, problem, solvePoisson(cells, problem, plain));
    CAPTURE(plainErrors);
    CHECK(errors[size_t(i)][0] <= plainErrors[0] / 4);
    CHECK(errors[size_t(i)][1] <= plainErrors[1] / 4);
  }
  CAPTURE(errors);
  CHECK(std::log2(errors[0][0] / errors[1][0]) >= 1.8);
  CHECK(std::log2(errors[0][1] / errors[1][1]) >= 1.1);
}

TEST_CASE("poisson solver: fluxes, times coefficients, balance sources and mass", "[poisson]") {
  const CellComplex cells = ballCells({true, true}, 12);
  const PoissonProblem problem = wavesProblem(cells);
  const Solution solution = solvePoisson(cells, problem);
  std::vector<double> left(cells.cellCount());
  double all = 0;
  const auto add = [&](int32_t cell, double flow) { left[size_t(cell)] += flow, all += std::fabs(flow); };
  for (size_t c = 0; c < left.size(); ++c) add(int32_t(c), -(problem.source[c] + kMass * solution.phi[c]) * cells.cellVolume[c]);
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    const double flow = solution.faceDerivative[f] * cells.faceArea[f] * problem.faceCoefficient[f];
    if (flow != 0) add(cells.faceCells[2 * f], flow), add(cells.faceCells[2 * f + 1], -flow);
  }
  for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
    const uint32_t h = problem.boundary.halfFaces[b];
    add(cells.faceCells[h], solution.boundaryDerivative[b] * cells.faceArea[h / 2] * problem.faceCoefficient[h / 2]);
  }
  for (const double l : left) REQUIRE(std::fabs(l) <= 1e-9 * all);
}

TEST_CASE("poisson solver: the system with a coefficient that jumps and a mass is symmetric, and solved as by a direct solver",
          "[poisson]") {
  const CellComplex cells = complexOf(shapes::icosphere({3.3, 3.1, 2.9}, 1.2, 1), Grid::box({0, 0, 0}, {8, 8, 8}, {8, 8, 8}), 2, 1);
  PoissonProblem problem = wavesProblem(cells);
  for (size_t f = 0; f < cells.faceCount(); ++f) problem.faceCoefficient[f] = f % 3 == 0 ? 100 : 0.1 + double(f % 7);
  const PoissonSystem system = poissonSystem(cells, problem);
  const Eigen::MatrixXd matrix(eigenOf(system.matrix));
  CHECK((matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= 1e-13 * matrix.cwiseAbs().maxCoeff());
  CHECK(system.nullSpace.columns == 0);
  SolveOptions options;
  options.corrections = 0;
  options.tolerance = 1e-13;
  const Solution solution = solvePoisson(cells, problem, options);
  CHECK(solution.status == SolveStatus::converged);
  const Eigen::VectorXd expected = matrix.ldlt().solve(vectorOf(system.rhs));
  CHECK(largest(vectorOf(solution.phi) - expected) <= 1e-10 * largest(expected));
}

TEST_CASE("poisson solver: two layers of different coefficients, with the harmonic mean between them", "[poisson]") {
  Mesh outsideOfGrid = shapes::icosphere({9, 9, 9}, 0.5, 0);
  const Layers layers(outsideOfGrid);
  const Solution solution = solvePoisson(layers.cells, layers.problem);
  REQUIRE(solution.status == SolveStatus::converged);
  for (size_t c = 0; c < layers.cells.cellCount(); ++c)
    CHECK(solution.phi[c] == Approx(Layers::phi(layers.cells.cellCentre[3 * c])).margin(1e-9));
  for (size_t f = 0; f < layers.cells.faceCount(); ++f) {
    const double flux = solution.faceDerivative[f] * layers.problem.faceCoefficient[f];
    if (layers.cells.faceNormal[3 * f] != 0 && layers.cells.faceTag[f] == FaceTag::inner) CHECK(std::fabs(flux) == Approx(Layers::flux()));
  }
}

TEST_CASE("poisson solver: corrections leave alone what is beside a jump of the coefficient", "[poisson]") {
  // A sheet that ends in the plane of the jump, along the flux: cells are cut on both sides, and the solution stays that without it.
  const Layers layers(shapes::quad({1.2, 0.7, 1.5}, {2.8, 0.7, 1.5}, {2.8, 3.3, 1.5}, {1.2, 3.3, 1.5}));
  const Solution solution = solvePoisson(layers.cells, layers.problem);
  REQUIRE(solution.status == SolveStatus::converged);
  for (size_t c = 0; c < layers.cells.cellCount(); ++c)
    CHECK(solution.phi[c] == Approx(Layers::phi(layers.cells.cellCentre[3 * c])).margin(1e-9));
}

TEST_CASE("poisson solver: a mass alone holds phi", "[poisson]") {
  const CellComplex cells = ballCells({}, 8);
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  problem.mass.assign(cells.cellCount(), 2);
  problem.source.assign(cells.cellCount(), -6);
  const Solution solution = solvePoisson(cells, problem);
  CHECK(solution.status == SolveStatus::converged);
  for (const double phi : solution.phi) CHECK(phi == Approx(3));
  const uint32_t region = cells.cellRegion.back();
  for (size_t c = 0; c < cells.cellCount(); ++c) problem.mass[c] = cells.cellRegion[c] == region ? 2 : 0;
  CHECK(solvePoisson(cells, problem).incompatible.size() == 1);
  CHECK(poissonSystem(cells, problem).nullSpace.columns == 1);
}

TEST_CASE("poisson solver: used again it finds the bits that it finds once, on any number of threads", "[poisson]") {
  const CellComplex cells = ballCells({.isMerged = true}, 12);
  PoissonProblem problem = wavesProblem(cells);
  PoissonSolver solver(cells, problem);
  for (const double factor : {1.0, -3.0}) {
    for (double& s : problem.source) s *= factor;
    for (double& v : problem.boundary.value) v += factor;
    const Solution once = solvePoisson(cells, problem);
    for (const unsigned threads : {1u, 3u}) {
      SolveOptions options;
      options.threads = threads;
      CHECK(areSame(solver.solve({problem.source, problem.boundary.value, {}}, options), once));
    }
  }
  PoissonSolver moved = std::move(solver);
  CHECK(areSame(moved.solve({problem.source, problem.boundary.value, {}}), solvePoisson(cells, problem)));
  problem.source.clear();
  problem.boundary.value.assign(problem.boundary.value.size(), 0);
  CHECK(areSame(moved.solve({}), solvePoisson(cells, problem)));
}

TEST_CASE("poisson solver: the same bits on any number of threads where there are cells for them", "[poisson]") {
  for (const bool isCoarsened : {false, true}) {
    const CellComplex cells = ballCells({.isCoarsened = isCoarsened, .isMerged = true}, isCoarsened ? 56 : 32);
    REQUIRE(cells.cellCount() > 18'000);
    const PoissonProblem problem = wavesProblem(cells);
    SolveOptions options;
    options.threads = 1;
    const Solution one = solvePoisson(cells, problem, options);
    CHECK(one.status == SolveStatus::converged);
    for (const unsigned threads : {2u, 3u}) {
      options.threads = threads;
      CHECK(areSame(PoissonSolver(cells, problem, threads).solve({problem.source, problem.boundary.value, {}}, options), one));
    }
  }
}

TEST_CASE("poisson solver: started from a phi nearby it needs less, and finds the same", "[poisson]") {
  const CellComplex cells = ballCells({.isMerged = true}, 12);
  const PoissonProblem problem = wavesProblem(cells);
  PoissonSolver solver(cells, problem);
  const PoissonData data{problem.source, problem.boundary.value, {}};
  const Solution cold = solver.solve(data);
  std::vector<double> near = cold.phi;
  for (size_t c = 0; c < near.size(); ++c) near[c] *= 1 + 1e-6 * std::sin(double(c));
  const Solution warm = solver.solve({problem.source, problem.boundary.value, near});
  CHECK(warm.status == SolveStatus::converged);
  CHECK(2 * warm.iterations() <= cold.iterations());
  CHECK(largest(vectorOf(warm.phi) - vectorOf(cold.phi)) <= 2e-5);
  const std::vector<double> nonsense(cells.cellCount(), 1e300);
  CHECK(areSame(solver.solve({problem.source, problem.boundary.value, nonsense}), cold));
  // Where nothing is asked, the start is not an answer.
  const std::vector<double> start(cells.cellCount(), 1);
  CHECK(largest(vectorOf(solver.solve({{}, {}, start}).phi)) == 0);
}

TEST_CASE("poisson solver: bad coefficients, masses and data are refused by name", "[poisson]") {
  const CellComplex cells = ballCells({}, 8);
  const PoissonProblem good = wavesProblem(cells);
  const auto refused = [&](const auto& change) {
    PoissonProblem problem = good;
    change(problem);
    const auto found = refusal([&] { poissonSystem(cells, problem); });
    CHECK(refusal([&] { PoissonSolver(cells, problem); }) == found);
    CHECK(refusal([&] { solvePoisson(cells, problem); }) == found);
    return found;
  };
  const auto at = [](int64_t element) { return std::pair(Status::badArgument, element); };
  CHECK(refused([](PoissonProblem& p) { p.faceCoefficient[9] = 0; }) == at(9));
  CHECK(refused([](PoissonProblem& p) { p.faceCoefficient[8] = NAN; }) == at(8));
  CHECK(refused([](PoissonProblem& p) { p.faceCoefficient.pop_back(); }) == at(-1));
  CHECK(refused([](PoissonProblem& p) { p.mass[7] = -1e-9; }) == at(7));
  CHECK(refused([](PoissonProblem& p) { p.mass[6] = INFINITY; }) == at(6));
  CHECK(refused([](PoissonProblem& p) { p.mass.push_back(1); }) == at(-1));
  PoissonSolver solver(cells, good);
  std::vector<double> perCell(cells.cellCount()), values(good.boundary.value.size());
  perCell[5] = NAN;
  values[4] = INFINITY;
  CHECK(refusal([&] { solver.solve({perCell, {}, {}}); }) == at(5));
  CHECK(refusal([&] { solver.solve({{}, values, {}}); }) == at(good.boundary.halfFaces[4]));
  CHECK(refusal([&] { solver.solve({{}, {}, perCell}); }) == at(5));
  CHECK(refusal([&] { solver.rightSide({perCell, {}, {}}); }) == at(5));
  CHECK(refusal([&] { solver.rightSide({{}, values, {}}); }) == at(good.boundary.halfFaces[4]));
  perCell.pop_back();
  CHECK(refusal([&] { solver.solve({perCell, {}, {}}); }) == at(-1));
  CHECK(refusal([&] { solver.solve({{}, {}, perCell}); }) == at(-1));
  CHECK(refusal([&] { solver.solve({}, SolveOptions{{}, 0}); }).first == Status::badOption);
}
