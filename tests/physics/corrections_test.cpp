// Derivatives of second order, which solvePoisson() corrects its system by.
#include <cmath>

#include "waves.h"

using namespace mandoline;

namespace {

/// With phi given on the surface and the sides, or the Robin condition of this coefficient.
PoissonProblem heldProblem(const CellComplex& cells, DualPoints points, double coefficient = 0) {
  PoissonProblem problem;
  problem.dualPoints = points;
  problem.boundary = boundaryOf(cells);
  const std::vector<double> normals = outwardNormals(problem.boundary, cells);
  for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
    const double* x = &cells.faceCentroid[3 * (problem.boundary.halfFaces[b] / 2)];
    problem.boundary.condition[b] = coefficient > 0 ? Condition::robin : Condition::dirichlet;
    problem.boundary.coefficient[b] = coefficient;
    problem.boundary.value[b] = coefficient > 0 ? coefficient * waves(x) + dot(wavesGradient(x), normals, b) : waves(x);
  }
  for (size_t c = 0; c < cells.cellCount(); ++c) problem.source.push_back(-1.75 * waves(&cells.cellCentroid[3 * c]));
  return problem;
}

Solution solved(const CellComplex& cells, const PoissonProblem& problem, int corrections = SolveOptions().corrections) {
  SolveOptions options;
  options.corrections = corrections;
  Solution solution = solvePoisson(cells, problem, options);
  REQUIRE(solution.status == SolveStatus::converged);
  return solution;
}

/// The largest error of a derivative between two cells.
double faceError(const CellComplex& cells, const Solution& solution) {
  double error = 0;
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    const bool isInner = cells.faceTag[f] == FaceTag::inner && std::min(cells.faceCells[2 * f], cells.faceCells[2 * f + 1]) >= 0;
    if (!isInner || !(cells.faceArea[f] > 0)) continue;
    const double exact = dot(wavesGradient(&cells.faceCentroid[3 * f]), cells.faceNormal, f);
    error = std::max(error, std::fabs(solution.faceDerivative[f] - exact));
  }
  return error;
}

}  // namespace

TEST_CASE("corrections: where phi is held on a ball, it and what flows through it are of second order", "[corrections]") {
  for (const double coefficient : {0.0, 0.3, 5.0}) {
    for (const Cells way : {Cells{}, Cells{false, true}, Cells{true, true}}) {
      CAPTURE(coefficient, way.isCoarsened, way.isMerged);
      std::array<std::array<double, 2>, 2> errors;
      for (const int i : {0, 1}) {
        const CellComplex cells = ballCells(way, 12 << i);
        const PoissonProblem problem = heldProblem(cells, DualPoints::centroids, coefficient);
        errors[size_t(i)] = wavesErrors(cells, problem, solved(cells, problem));
        const auto plain = wavesErrors(cells, problem, solved(cells, problem, 0));
        CHECK(errors[size_t(i)][0] <= plain[0] / 5);
        CHECK(errors[size_t(i)][1] <= plain[1] / 5);
      }
      CAPTURE(errors);
      const double least = way.isCoarsened ? 0 : 1.8;  // octree cells have the same layers
      CHECK(std::log2(errors[0][0] / errors[1][0]) >= least);
      CHECK(std::log2(errors[0][1] / errors[1][1]) >= (way.isCoarsened ? 0.5 : 1));
    }
  }
}

TEST_CASE("corrections: merged cells beside larger ones are of second order, too", "[corrections]") {
  const CellComplex cells = ballCells({true, true}, 24);
  const auto isBesideLarger = [&](size_t f) {
    const int32_t a = cells.faceCells[2 * f], b = cells.faceCells[2 * f + 1];
    if (std::min(a, b) < 0 || cells.cellLevel[size_t(a)] == cells.cellLevel[size_t(b)]) return false;
    return std::min(a, b) < int32_t(cells.cutCells);
  };
  size_t count = 0;
  for (size_t f = 0; f < cells.faceCount(); ++f) count += isBesideLarger(f);
  REQUIRE(count > 0);
  const PoissonProblem problem = heldProblem(cells, DualPoints::centroids);
  const Solution solution = solved(cells, problem);
  CHECK(wavesErrors(cells, problem, solution)[0] <= 2e-4);
  CHECK(faceError(cells, solution) <= 5e-3);
}

TEST_CASE("corrections: faces at the corners of merged cells, far from the line between them", "[corrections]") {
  const CellComplex cells = ballCells({false, true}, 16);
  CHECK(faceError(cells, solved(cells, heldProblem(cells, DualPoints::centroids))) <= 4e-3);
}

TEST_CASE("corrections: what flows into a cell balances its source", "[corrections]") {
  for (const auto& [points, coefficient] :
       {std::pair(DualPoints::centres, 0.0), {DualPoints::centroids, 0.0}, {DualPoints::centroids, 3.0}}) {
    const CellComplex cells = ballCells({true, true}, 12);
    const PoissonProblem problem = heldProblem(cells, points, coefficient);
    const Solution solution = solved(cells, problem);
    std::vector<double> left(cells.cellCount());
    double all = 0;
    const auto add = [&](int32_t cell, double flow) { left[size_t(cell)] += flow, all += std::fabs(flow); };
    for (size_t c = 0; c < left.size(); ++c) add(int32_t(c), -problem.source[c] * cells.cellVolume[c]);
    for (size_t f = 0; f < cells.faceCount(); ++f) {
      const double flow = solution.faceDerivative[f] * cells.faceArea[f];
      if (flow != 0) add(cells.faceCells[2 * f], flow), add(cells.faceCells[2 * f + 1], -flow);
    }
    for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
      const uint32_t h = problem.boundary.halfFaces[b];
      add(cells.faceCells[h], solution.boundaryDerivative[b] * cells.faceArea[h / 2]);
    }
    for (size_t c = 0; c < left.size(); ++c) REQUIRE(std::fabs(left[c]) <= 1e-9 * all);
  }
}

TEST_CASE("corrections: without them derivatives are those of gradient()", "[corrections]") {
  const CellComplex cells = ballCells({true, false}, 12);
  const Solution solution = solved(cells, heldProblem(cells, DualPoints::centres), 0);
  const Eigen::VectorXd expected = gradient(cells) * vectorOf(solution.phi);
  CHECK(largest(vectorOf(solution.faceDerivative) - expected) <= 1e-12 * largest(expected));
}

TEST_CASE("corrections: a linear field on merged cells", "[corrections]") {
  // Their dual points are those of their bases, so the plain derivatives beside them are not exact.
  const CellComplex cells = ballCells({false, true}, 12);
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  problem.boundary.value = products({0.75, -1.25, 0.5}, outwardNormals(problem.boundary, cells));
  const auto error = [&](int corrections) {
    const Solution solution = solved(cells, problem, corrections);
    double largest = 0;
    for (size_t f = 0; f < cells.faceCount(); ++f) {
      if (solution.faceDerivative[f] == 0 || cells.faceArea[f] < 1e-6) continue;
      largest = std::max(largest, std::fabs(solution.faceDerivative[f] - dot({0.75, -1.25, 0.5}, cells.faceNormal, f)));
    }
    return largest;
  };
  const double plain = error(0), corrected = error(SolveOptions().corrections);
  CAPTURE(plain, corrected);
  CHECK(plain >= 0.1);
  CHECK(corrected <= 1e-3 * plain);
}

TEST_CASE("corrections: between octree cells of one size a derivative's mean on the face is of fourth order", "[corrections]") {
  // No surface, and one size: what errs is only how derivatives are found.
  const auto error = [](int64_t n) {
    const CellComplex cells = complexOf(shapes::cube(9, 10), Grid::box({-1, -1, -1}, {1, 1, 1}, {2 * n, 2 * n, 2 * n}), 1);
    PoissonProblem problem;
    problem.boundary = boundaryOf(cells);
    const std::vector<double> normals = outwardNormals(problem.boundary, cells);
    const double size = 2 / double(n), mean = std::sin(size / 2) / (size / 2);  // of a sine along one axis, to its value in the middle
    for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
      const double *p = &cells.faceCentroid[3 * (problem.boundary.halfFaces[b] / 2)], *normal = &normals[3 * b];
      const double along = normal[0] * std::cos(p[0]) * std::sin(p[1]) + normal[1] * std::sin(p[0]) * std::cos(p[1]);
      problem.boundary.value[b] = mean * along;
    }
    for (size_t c = 0; c < cells.cellCount(); ++c)
      problem.source.push_back(-2 * mean * mean * std::sin(cells.cellCentre[3 * c]) * std::sin(cells.cellCentre[3 * c + 1]));
    const Solution solution = solved(cells, problem);
    double sum = 0;
    for (size_t c = 0; c < cells.cellCount(); ++c)
      sum += std::fabs(solution.phi[c] - std::sin(cells.cellCentre[3 * c]) * std::sin(cells.cellCentre[3 * c + 1]));
    return sum / double(cells.cellCount());
  };
  const double coarse = error(8), fine = error(16);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) >= 3);
  CHECK(coarse <= 1e-4);
}

TEST_CASE("corrections: octree cells right beside cut-cells do no harm", "[corrections]") {
  const Mesh mesh = shapes::icosphere({0.1, 0.05, -0.02}, 0.6, 4);
  const CellComplex cells = complexOf(mesh, Grid::box({-1, -1, -1}, {1, 1, 1}, {32, 32, 32}), 24);
  const PoissonProblem problem = heldProblem(cells, DualPoints::centroids);
  CHECK(wavesErrors(cells, problem, solved(cells, problem))[0] <= wavesErrors(cells, problem, solved(cells, problem, 0))[0]);
}

TEST_CASE("corrections: the same bits for any number of threads", "[corrections]") {
  const CellComplex cells = ballCells({true, true}, 24);
  const PoissonProblem problem = heldProblem(cells, DualPoints::centroids);
  SolveOptions options;
  options.threads = 1;
  const Solution one = solvePoisson(cells, problem, options);
  options.threads = 3;
  const Solution three = solvePoisson(cells, problem, options);
  CHECK(one.phi == three.phi);
  CHECK(one.faceDerivative == three.faceDerivative);
  CHECK(one.boundaryDerivative == three.boundaryDerivative);
}

TEST_CASE("corrections: a Robin coefficient of 0 gives what a Neumann condition gives, a negative one is refused", "[corrections]") {
  const CellComplex cells = ballCells({}, 8);
  PoissonProblem neumann = heldProblem(cells, DualPoints::centroids), robin = neumann;
  for (size_t b = 0; b < neumann.boundary.halfFaces.size(); ++b) {
    if (cells.faceTag[neumann.boundary.halfFaces[b] / 2] != FaceTag::xMin) continue;
    neumann.boundary.condition[b] = Condition::neumann;
    robin.boundary.condition[b] = Condition::robin;
  }
  CHECK(solved(cells, neumann).phi == solved(cells, robin).phi);
  setRobin(robin.boundary, cells, FaceTag::xMin, -1, 1);
  REQUIRE_THROWS_AS(poissonSystem(cells, robin), CallError);
  setRobin(robin.boundary, cells, FaceTag::xMin, std::nan(""), 1);
  REQUIRE_THROWS_AS(poissonSystem(cells, robin), CallError);
}

TEST_CASE("corrections: their number is not negative", "[corrections]") {
  const CellComplex cells = ballCells({}, 2);
  SolveOptions options;
  options.corrections = -1;
  REQUIRE_THROWS_AS(solvePoisson(cells, heldProblem(cells, DualPoints::centres), options), CallError);
}
