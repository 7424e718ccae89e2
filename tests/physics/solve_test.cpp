// Poisson's equation solved: against exact solutions, and what data without a solution get.
#include <Eigen/Dense>

#include "case_list.h"
#include "checked_cut.h"
#include "complexes.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

const std::array<double, 3> kField = {0.75, -1.25, 0.5};

Mesh ball() { return shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2); }

SolveOptions within(double tolerance) {
  SolveOptions options;
  options.tolerance = tolerance;
  return options;
}

/// The conditions of a wind that blows through everything.
PoissonProblem windThrough(const CellComplex& cells, const std::array<double, 3>& wind) {
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  problem.boundary.value = products(wind, outwardNormals(problem.boundary, cells));
  return problem;
}

/// Those of a wind that the surface stops.
PoissonProblem windAround(const CellComplex& cells, const std::array<double, 3>& wind) {
  PoissonProblem problem = windThrough(cells, wind);
  setBoundary(problem.boundary, cells, FaceTag::surface, Condition::neumann, 0);
  return problem;
}

/// The largest error against a linear field, up to a constant per component.
double linearError(const CellComplex& cells, const std::vector<double>& phi, const std::array<double, 3>& field) {
  const CellComponents components = cellComponents(cells);
  std::vector<double> low(components.count, HUGE_VAL), high(components.count, -HUGE_VAL);
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const uint32_t r = components.cellComponent[c];
    const double error = phi[c] - dot(field, cells.cellCentre, c);
    low[r] = std::min(low[r], error), high[r] = std::max(high[r], error);
  }
  double largest = 0;
  for (size_t r = 0; r < components.count; ++r) largest = std::max(largest, high[r] - low[r]);
  return largest;
}

/// The same in the cells that are not named as unresolved.
double linearErrorElsewhere(const CellComplex& cells, const Solution& solution) {
  std::vector<double> phi = solution.phi;
  const CellComponents components = cellComponents(cells);
  std::vector<double> sum(components.count), volume(components.count);
  for (size_t c = 0; c < phi.size(); ++c) {
    if (std::binary_search(solution.unresolved.begin(), solution.unresolved.end(), c)) continue;
    sum[components.cellComponent[c]] += cells.cellVolume[c] * (phi[c] - dot(kField, cells.cellCentre, c));
    volume[components.cellComponent[c]] += cells.cellVolume[c];
  }
  for (const uint32_t c : solution.unresolved) {
    const uint32_t r = components.cellComponent[c];
    phi[c] = dot(kField, cells.cellCentre, c) + (volume[r] > 0 ? sum[r] / volume[r] : 0);
  }
  return linearError(cells, phi, kField);
}

/// phi = sin(x) cos(y) exp(z / 2) outside of a ball: its values on the grid's sides, its normal derivative on the ball. Errors, mean and
/// largest.
std::array<double, 2> errorsOutsideOfBall(int64_t n, int maxLevel) {
  const auto phi = [](const double* x) { return std::sin(x[0]) * std::cos(x[1]) * std::exp(x[2] / 2); };
  const CellComplex all =
      complexOf(shapes::icosphere({0.1, 0.05, -0.02}, 0.6, 5), Grid::box({-1, -1, -1}, {1, 1, 1}, {n, n, n}), maxLevel, 1);
  const CellComplex cells = regionComplex(all, all.cellRegion.back()).cells;
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  const std::vector<double> normals = outwardNormals(problem.boundary, cells);
  for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
    const size_t f = problem.boundary.halfFaces[b] / 2;
    const double* x = &cells.faceCentroid[3 * f];
    if (cells.faceTag[f] != FaceTag::surface) {
      problem.boundary.condition[b] = Condition::dirichlet;
      problem.boundary.value[b] = phi(x);
      continue;
    }
    const double e = std::exp(x[2] / 2);
    problem.boundary.value[b] = dot({std::cos(x[0]) * std::cos(x[1]) * e, -std::sin(x[0]) * std::sin(x[1]) * e, phi(x) / 2}, normals, b);
  }
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double half = std::ldexp(1.0 / double(n), cells.cellLevel[c]);  // of a cell's side; in cut-cells the centroid will do
    const double mean = c < cells.cutCells ? 1 : std::pow(std::sin(half) / half, 2) * std::sinh(half / 2) / (half / 2);
    problem.source.push_back(-1.75 * mean * phi(&cells.cellCentroid[3 * c]));
  }
  const Solution solution = solvePoisson(cells, problem);
  REQUIRE(solution.status == SolveStatus::converged);
  double sum = 0, volume = 0, most = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double error = std::fabs(solution.phi[c] - phi(&cells.cellCentre[3 * c]));
    sum += error * cells.cellVolume[c], volume += cells.cellVolume[c], most = std::max(most, error);
  }
  return {sum / volume, most};
}

}  // namespace

TEST_CASE("solve: linear fields come out in all cases, single grid cells and octree cells", "[solve]") {
  for (const NamedCase& c : caseList()) {
    for (const int maxLevel : {0, 24}) {
      const CellComplex cells = complexOf(c.mesh, c.grid, maxLevel);
      const Solution solution = solvePoisson(cells, windThrough(cells, kField), within(1e-13));
      CAPTURE(c.name, maxLevel, solution.residuals);
      CHECK(solution.status == SolveStatus::converged);
      CHECK(linearError(cells, solution.phi, kField) <= 1e-10 * sizeOf(cells));
    }
  }
}

TEST_CASE("solve: second order outside of a ball, single grid cells and octree cells of two sizes", "[solve]") {
  for (const int maxLevel : {0, 1}) {
    const int64_t n = maxLevel ? 32 : 16;
    const auto coarse = errorsOutsideOfBall(n, maxLevel), fine = errorsOutsideOfBall(2 * n, maxLevel);
    CAPTURE(maxLevel, coarse, fine);
    CHECK(std::log2(coarse[0] / fine[0]) >= 1.8);
    CHECK(std::log2(coarse[1] / fine[1]) >= 1.5);
    if (maxLevel) CHECK(fine[0] <= 5e-7);  // with derivatives of second order at sides of the grid and where sizes meet 3e-6
  }
}

TEST_CASE("solve: what a direct solver finds", "[solve]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  for (const DualPoints points : {DualPoints::centres, DualPoints::centroids}) {
    PoissonProblem problem = windAround(cells, kField);
    problem.dualPoints = points;
    setBoundary(problem.boundary, cells, FaceTag::surface, Condition::dirichlet, 2);
    setBoundary(problem.boundary, cells, FaceTag::xMax, Condition::dirichlet, -1);
    const PoissonSystem system = poissonSystem(cells, problem);
    const Eigen::VectorXd expected = Eigen::MatrixXd(eigenOf(system.matrix)).ldlt().solve(vectorOf(system.rhs));
    SolveOptions options = within(1e-13);
    options.corrections = 0;
    const Solution solution = solvePoisson(cells, problem, options);
    CHECK(solution.status == SolveStatus::converged);
    CHECK(largest(vectorOf(solution.phi) - expected) <= 1e-9);
  }
}

TEST_CASE("solve: as many iterations on fine grids as on coarse ones", "[solve]") {
  std::vector<size_t> iterations;
  for (const int64_t n : {8, 16, 32}) {
    const CellComplex cells = complexOf(shapes::torus({0, 0, 0}, 0.6, 0.2, 24, 12), Grid::box({-1, -1, -1}, {1, 1, 1}, {n, n, n}));
    SolveOptions options;
    options.corrections = 0;
    iterations.push_back(solvePoisson(cells, windAround(cells, {1, 0, 0}), options).iterations());
  }
  CAPTURE(iterations);
  CHECK(iterations[2] <= iterations[0] + 6);
  CHECK(iterations[2] <= 24);
}

TEST_CASE("solve: two halves of a long channel, joined by a slit", "[solve]") {
  // Blocks halve along one axis only, and on each level the halves are joined as weakly as on the finest.
  const CellComplex cells = complexOf(shapes::quad({32, -1, -1}, {32, 1.9, -1}, {32, 1.9, 3}, {32, -1, 3}), unitGrid(64, 2, 2));
  REQUIRE(cellComponents(cells).count == 1);
  const Solution solution = solvePoisson(cells, windThrough(cells, kField), within(1e-13));
  CAPTURE(solution.residuals);
  CHECK(solution.status == SolveStatus::converged);
  CHECK(linearError(cells, solution.phi, kField) <= 1e-10 * 64);
}

TEST_CASE("solve: cells that only the tiniest faces connect", "[solve]") {
  // Balls that touch planes of the grid, but for 1e-14: what is beyond has faces of 1e-14 or 1e-28.
  for (const double beyond : {1e-7, 1e-10, 1e-14}) {
    const Mesh mesh = shapes::merged({shapes::icosphere({2.5 + beyond, 2.5 - beyond, 2.5}, 0.5, 2),
                                      shapes::icosphere({5.5, 4 + beyond, 4 - beyond}, 1, 2), shapes::cube(1 - beyond, 2 + beyond)});
    const CellComplex cells = complexOf(mesh, unitGrid(7));
    for (const double tolerance : {1e-10, 1e-13}) {
      const Solution solution = solvePoisson(cells, windThrough(cells, kField), within(tolerance));
      CAPTURE(beyond, tolerance, solution.residuals);
      CHECK(solution.status == SolveStatus::converged);
      CHECK(linearError(cells, solution.phi, kField) <= 100 * tolerance);
    }
  }
}

TEST_CASE("solve: cells that rounding leaves open are named", "[solve]") {
  // A box ends three units of rounding beyond a plane, where octree cells meet four slivers at once: only the mean of their phi is held.
  const Mesh box = shapes::box({1.3, 1.3, 1.3}, {6 + 0x3p-50, 6.7, 6.7});
  std::vector<uint32_t> slivers;
  for (const int fineLayers : {0, 1}) {
    const CellComplex cells = complexOf(box, unitGrid(8), 24, fineLayers);
    const Solution solution = solvePoisson(cells, windThrough(cells, kField), within(1e-13));
    CAPTURE(fineLayers, solution.residuals);
    CHECK(solution.status == (fineLayers == 0 ? SolveStatus::unresolved : SolveStatus::converged));
    CHECK(solution.unresolved.empty() == (fineLayers > 0));
    for (const uint32_t c : solution.unresolved) CHECK(cells.cellVolume[c] < 1e-14);
    CHECK(linearErrorElsewhere(cells, solution) <= 1e-10 * 8);
  }
}

TEST_CASE("solve: of a pocket that is open at nearly no area, phi is named as a whole", "[solve]") {
  // A plate of a thickness of 1e-13: what flows in on one side and out on the other is rounded by as much as its cells exchange.
  const CellComplex cells = complexOf(shapes::box({1.3, 1.4, 3.5}, {6.6, 6.7, 3.5 + 1e-13}), unitGrid(8));
  const Solution solution = solvePoisson(cells, windThrough(cells, kField), within(1e-13));
  CHECK(solution.status == SolveStatus::unresolved);
  CHECK(linearErrorElsewhere(cells, solution) <= 1e-5);
  CHECK(solvePoisson(cells, windAround(cells, kField), within(1e-13)).status == SolveStatus::converged);  // nothing flows in
}

TEST_CASE("solve: in any unit of length", "[solve]") {
  const auto phi = [](double unit) {
    const Mesh mesh = shapes::icosphere({3.3 * unit, 3.1 * unit, 2.9 * unit}, 1.7 * unit, 2);
    const CellComplex cells = complexOf(mesh, Grid::box({0, 0, 0}, {7 * unit, 7 * unit, 7 * unit}, {7, 7, 7}));
    PoissonProblem problem;
    problem.boundary = boundaryOf(cells);
    setBoundary(problem.boundary, cells, FaceTag::xMin, Condition::dirichlet, 1);
    setBoundary(problem.boundary, cells, FaceTag::zMax, Condition::dirichlet, -1);
    const Solution solution = solvePoisson(cells, problem, within(1e-13));
    CHECK(solution.status == SolveStatus::converged);
    return solution.phi;
  };
  const std::vector<double> expected = phi(1);
  CHECK(largest(vectorOf(expected)) > 0.8);
  for (const double unit : {0x1p-60, 0x1p60, 1e-65, 1e65}) CHECK(largest(vectorOf(phi(unit)) - vectorOf(expected)) <= 1e-10);
}

TEST_CASE("solve: phi in any unit", "[solve]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  const Solution one = solvePoisson(cells, windAround(cells, {1, 0, 0}), within(1e-13));
  for (const double unit : {0x1p-1000, 0x1p-500, 0x1p1000}) {
    const Solution solution = solvePoisson(cells, windAround(cells, {unit, 0, 0}), within(1e-13));
    CHECK(solution.status == SolveStatus::converged);
    CHECK(solution.residuals == one.residuals);
    for (size_t c = 0; c < cells.cellCount(); ++c) REQUIRE(solution.phi[c] == one.phi[c] * unit);
  }
}

TEST_CASE("solve: where a dead end behind a slit of nearly no area is fed, residuals are true", "[solve]") {
  // Each edge of the prism that lies in a side of its box leaves a sliver there, which the wind enters and can leave by rounding errors
  // only.
  const Mesh prism{{20, -20, 0, -20, -20, 0, 20, 20, 0, 20, -20, 10, -20, -20, 10, 20, 20, 10},
                   {0, 1, 2, 3, 1, 0, 1, 3, 4, 5, 4, 3, 2, 3, 0, 3, 2, 5, 2, 4, 1, 4, 2, 5}};
  const CellComplex cells = complexOf(prism, Grid::around(prism, 12, 0));
  for (const FaceTag fed : {FaceTag::xMax, FaceTag::yMin, FaceTag::zMax}) {
    PoissonProblem problem;
    problem.boundary = boundaryOf(cells);
    setBoundary(problem.boundary, cells, fed, Condition::neumann, 1);
    setBoundary(problem.boundary, cells, FaceTag::xMin, Condition::dirichlet, 0);
    setBoundary(problem.boundary, cells, FaceTag::zMin, Condition::dirichlet, 0);
    SolveOptions options;
    options.corrections = 0;
    const Solution solution = solvePoisson(cells, problem, options);
    const PoissonSystem system = poissonSystem(cells, problem);
    const Eigen::VectorXd residual = vectorOf(system.rhs) - eigenOf(system.matrix) * vectorOf(solution.phi);
    const double found = residual.norm() / vectorOf(system.rhs).norm();
    CAPTURE(name(solution.status), solution.residuals, found);
    REQUIRE_FALSE(solution.residuals.empty());
    CHECK(std::fabs(found - solution.residuals.back()) <= 1e-12 + 1e-3 * found);
    CHECK(isSolved(solution.status) == (found <= 1e-10));
  }
}

TEST_CASE("solve: a plate edge-on changes nothing, broadside it blocks", "[solve]") {
  const CellComplex cells = complexOf(shapes::quad({1.5, 1.5, 2.5}, {4.5, 1.5, 2.5}, {4.5, 4.5, 2.5}, {1.5, 4.5, 2.5}), unitGrid(6));
  CHECK(linearError(cells, solvePoisson(cells, windAround(cells, {1, 0.5, 0}), within(1e-13)).phi, {1, 0.5, 0}) <= 1e-10);
  const Solution broadside = solvePoisson(cells, windAround(cells, {0, 0, 1}));
  CHECK(broadside.status == SolveStatus::converged);
  // phi jumps at the plate: the wind is dammed on one side.
  double before = 0, behind = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    if (cells.cellCorner[3 * c] != 3 || cells.cellCorner[3 * c + 1] != 3 || cells.cellCorner[3 * c + 2] != 2) continue;
    (cells.cellCentroid[3 * c + 2] < 2.5 ? before : behind) = broadside.phi[c];
  }
  CHECK(behind - before > 1);
}

TEST_CASE("solve: inside of a closed shell nothing flows", "[solve]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  const Solution solution = solvePoisson(cells, windAround(cells, {1, 0, 0}));
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    if (cells.cellRegion[c] != cells.cellRegion.back()) REQUIRE(std::fabs(solution.phi[c]) <= 1e-12);
  }
}

TEST_CASE("solve: the free constant", "[solve]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  SolveOptions options;
  const PoissonProblem problem = windThrough(cells, kField);
  const CellComponents components = cellComponents(cells);
  REQUIRE(components.count == 2);
  const std::vector<double> mean = solvePoisson(cells, problem, options).phi;
  std::vector<double> sums(2);
  for (size_t c = 0; c < cells.cellCount(); ++c) sums[components.cellComponent[c]] += mean[c] * cells.cellVolume[c];
  CHECK(std::fabs(sums[0]) <= 1e-10);
  CHECK(std::fabs(sums[1]) <= 1e-10);
  options.freeConstant = FreeConstant::pinned;
  const std::vector<double> pinned = solvePoisson(cells, problem, options).phi;
  for (uint32_t r = 0; r < 2; ++r) {
    const auto first = std::find(components.cellComponent.begin(), components.cellComponent.end(), r);
    CHECK(pinned[size_t(first - components.cellComponent.begin())] == 0);
  }
  CHECK(pinned.back() - pinned[cells.cellCount() - 2] == Approx(mean.back() - mean[cells.cellCount() - 2]));
}

TEST_CASE("solve: data without a solution are incompatible, unless they are balanced", "[solve]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  PoissonProblem problem = windAround(cells, {1, 0, 0});
  const CellComponents components = cellComponents(cells);
  setBoundary(problem.boundary, cells, FaceTag::xMax, Condition::neumann, 3);
  SolveOptions options;
  const Solution refused = solvePoisson(cells, problem, options);
  CHECK(refused.status == SolveStatus::incompatible);
  CHECK(refused.incompatible == std::vector<uint32_t>{components.cellComponent.back()});
  CHECK(refused.excess.size() == 1);
  CHECK(refused.excess.at(0) == Approx(2 * 49));
  CHECK(refused.phi == std::vector<double>(cells.cellCount()));
  options.balance = true;
  CHECK(solvePoisson(cells, problem, options).status == SolveStatus::converged);
  options.balance = false;
  setBoundary(problem.boundary, cells, FaceTag::yMin, Condition::dirichlet, 0);
  CHECK(solvePoisson(cells, problem, options).status == SolveStatus::converged);
  // A sheet through the whole grid: what blows in can't get out.
  const CellComplex halves = complexOf(shapes::quad({-1, -1, 2.5}, {9, -1, 2.5}, {9, 9, 2.5}, {-1, 9, 2.5}), unitGrid(5));
  CHECK(solvePoisson(halves, windAround(halves, {0, 0, 1})).status == SolveStatus::incompatible);
  CHECK(solvePoisson(halves, windAround(halves, {1, 0, 0})).status == SolveStatus::converged);
}

TEST_CASE("solve: components that can be solved are, where another one is incompatible", "[solve]") {
  const CellComplex cells = complexOf(shapes::quad({-1, -1, 2.5}, {9, -1, 2.5}, {9, 9, 2.5}, {-1, 9, 2.5}), unitGrid(5));
  const CellComponents components = cellComponents(cells);
  REQUIRE(components.count == 2);
  PoissonProblem problem = windAround(cells, {1, 0, 0});
  const Solution solved = solvePoisson(cells, problem);
  REQUIRE(solved.status == SolveStatus::converged);
  CHECK(solved.incompatible.empty());
  for (const uint32_t bad : {0u, 1u}) {
    problem.source.assign(cells.cellCount(), 0);
    double volume = 0;
    for (size_t c = 0; c < cells.cellCount(); ++c) {
      if (components.cellComponent[c] != bad) continue;
      problem.source[c] = 2;
      volume += cells.cellVolume[c];
    }
    const Solution solution = solvePoisson(cells, problem);
    CHECK(solution.status == SolveStatus::incompatible);
    CHECK(solution.incompatible == std::vector<uint32_t>{bad});
    CHECK(solution.excess.at(0) == Approx(-2 * volume));
    CHECK(solution.residuals.back() <= 1e-10);
    for (size_t c = 0; c < cells.cellCount(); ++c) {
      const bool isBad = components.cellComponent[c] == bad;
      REQUIRE(std::fabs(solution.phi[c] - (isBad ? 0 : solved.phi[c])) < 1e-8);
    }
  }
}

TEST_CASE("solve: sources that balancing cancels entirely leave phi at zero", "[solve]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  PoissonProblem problem = windAround(cells, {0, 0, 0});
  problem.source.assign(cells.cellCount(), 3.7);
  SolveOptions options;
  options.balance = true;
  const Solution solution = solvePoisson(cells, problem, options);
  CHECK(solution.status == SolveStatus::converged);
  CHECK(solution.phi == std::vector<double>(cells.cellCount()));
}

TEST_CASE("solve: limits, numbers that are too large, no cells at all", "[solve]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  PoissonProblem problem = windAround(cells, {1, 0, 0});
  SolveOptions options;
  options.maxIterations = 2;
  const Solution few = solvePoisson(cells, problem, options);
  CHECK(few.status == SolveStatus::iterationLimit);
  CHECK(few.iterations() == 2);
  CHECK(few.residuals[2] < few.residuals[0]);
  options.maxIterations = 500;
  problem = windAround(cells, {1e308, 0, 0});
  CHECK(solvePoisson(cells, problem, options).status == SolveStatus::breakdown);
  problem = windAround(cells, {0, 0, 0});
  CHECK(solvePoisson(cells, problem, options).phi == std::vector<double>(cells.cellCount()));
  CHECK(solvePoisson(subComplex(cells, {}).cells, PoissonProblem()).status == SolveStatus::converged);
  options.tolerance = 0;
  CHECK(refusal([&] { solvePoisson(cells, problem, options); }).first == Status::badOption);
  options = {}, options.maxIterations = -1;
  CHECK(refusal([&] { solvePoisson(cells, problem, options); }).first == Status::badOption);
}

TEST_CASE("solve: progress grows and cancels; the same bits for any number of threads", "[solve]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  const PoissonProblem problem = windAround(cells, {1, 0, 0});
  SolveOptions options;
  std::vector<size_t> done;
  options.progress = [&](const Progress& p) {
    if (p.stageIndex == 1 && p.total == 1000) done.push_back(p.done);
    return true;
  };
  options.threads = 1;
  const Solution one = solvePoisson(cells, problem, options);
  CHECK(done.size() == one.iterations());
  CHECK(done.back() > 500);
  options.threads = 3;
  const Solution three = solvePoisson(cells, problem, options);
  CHECK(one.phi == three.phi);
  CHECK(one.residuals == three.residuals);
  options.progress = [&](const Progress& p) { return p.done < 300; };
  CHECK(refusal([&] { solvePoisson(cells, problem, options); }).first == Status::cancelled);
}
