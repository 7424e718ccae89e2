// Poisson's equation as a system: boundary conditions, null spaces, and linear fields, which it has to hold for exactly.
#include "case_list.h"
#include "checked_cut.h"
#include "complexes.h"
#include "mandoline/poisson.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

const std::array<double, 3> kField = {0.75, -1.25, 0.5};

PoissonProblem linearProblem(const CellComplex& cells) {
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  problem.boundary.value = products(kField, outwardNormals(problem.boundary, cells));
  return problem;
}

Mesh ball() { return shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2); }

}  // namespace

TEST_CASE("poisson: a linear field with its normal derivative given everywhere solves the system", "[poisson]") {
  for (const NamedCase& c : caseList()) {
    for (const int maxLevel : {0, 24}) {
      CAPTURE(c.name, maxLevel);
      const CellComplex cells = complexOf(c.mesh, c.grid, maxLevel);
      const PoissonSystem system = poissonSystem(cells, linearProblem(cells));
      const std::vector<double> phi = products(kField, cells.cellCentre);
      const double size = sizeOf(cells);
      CHECK(largest(eigenOf(system.matrix) * vectorOf(phi) - vectorOf(system.rhs)) <= 1e-13 * size * size);
      CHECK(isZero(SparseMatrix(eigenOf(system.matrix) * eigenOf(system.nullSpace)).pruned(1, 1e-13 * size)));
      CHECK(system.nullSpace.entryCount() == cells.cellCount());
    }
  }
}

TEST_CASE("poisson: a linear field with its values given on the sides of the grid solves the system", "[poisson]") {
  for (const int maxLevel : {0, 24}) {
    const CellComplex cells = complexOf(ball(), unitGrid(7, 8, 9), maxLevel);
    PoissonProblem problem = linearProblem(cells);
    for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
      const size_t f = problem.boundary.halfFaces[b] / 2;
      if (cells.faceTag[f] == FaceTag::surface) continue;
      problem.boundary.condition[b] = Condition::dirichlet;
      problem.boundary.value[b] = dot(kField, cells.faceCentroid, f);
    }
    const PoissonSystem system = poissonSystem(cells, problem);
    CHECK(largest(eigenOf(system.matrix) * vectorOf(products(kField, cells.cellCentre)) - vectorOf(system.rhs)) <= 1e-12);
    CHECK(system.nullSpace.columns == 1);  // the inside
  }
}

TEST_CASE("poisson: conditions by tag, one null space per region without a value", "[poisson]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  CHECK(poissonSystem(cells, problem).nullSpace.columns == 2);
  setBoundary(problem.boundary, cells, FaceTag::yMax, Condition::dirichlet, 3);
  setBoundary(problem.boundary, cells, FaceTag::zMin, Condition::neumann, 0.25);
  const PoissonSystem system = poissonSystem(cells, problem);
  CHECK(system.nullSpace.columns == 1);
  for (size_t c = cells.cutCells; c < cells.cellCount(); ++c) {  // unit cells
    const double held = cells.cellCorner[3 * c + 1] == 6 ? 2 : 0, flux = cells.cellCorner[3 * c + 2] == 0 ? 0.25 : 0;
    CHECK(system.rhs[c] == 3 * held + flux);
  }
  setBoundary(problem.boundary, cells, FaceTag::surface, Condition::dirichlet, 1);
  CHECK(poissonSystem(cells, problem).nullSpace.columns == 0);
}

TEST_CASE("poisson: a ball held at a value, in centroids: the matrix stays definite", "[poisson]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  PoissonProblem problem;
  problem.dualPoints = DualPoints::centroids;
  problem.boundary = boundaryOf(cells);
  setBoundary(problem.boundary, cells, FaceTag::surface, Condition::dirichlet, 1);
  const PoissonSystem system = poissonSystem(cells, problem);
  const SparseMatrix matrix = eigenOf(system.matrix);
  CHECK(largest(matrix * Eigen::VectorXd::Ones(matrix.cols()) - vectorOf(system.rhs)) <= 1e-9);  // phi = 1
  for (Eigen::Index c = 0; c < matrix.rows(); ++c) CHECK(matrix.coeff(c, c) > 0);
}

TEST_CASE("poisson: each side of a sheet has a value of its own", "[poisson]") {
  const CellComplex cells = complexOf(shapes::quad({1.5, 1.5, 2.5}, {3.5, 1.5, 2.5}, {3.5, 3.5, 2.5}, {1.5, 3.5, 2.5}), unitGrid(5));
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  double above = 0;
  for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
    const uint32_t h = problem.boundary.halfFaces[b];
    if (cells.faceTag[h / 2] == FaceTag::surface && h % 2 == 1) problem.boundary.value[b] = 1, above += cells.faceArea[h / 2];
  }
  CHECK(above == Approx(4));
  double sum = 0;
  for (const double r : poissonSystem(cells, problem).rhs) sum += r;
  CHECK(sum == Approx(4));
}

TEST_CASE("poisson: what does not fit is refused by name", "[poisson]") {
  const CellComplex cells = complexOf(ball(), unitGrid(7));
  PoissonProblem problem;
  CHECK(refusal([&] { poissonSystem(cells, problem); }).first == Status::badArgument);
  problem.boundary = boundaryOf(cells);
  problem.boundary.madeFrom = {};
  problem.boundary.halfFaces.pop_back();
  problem.boundary.condition.pop_back();
  problem.boundary.value.pop_back();
  CHECK(refusal([&] { poissonSystem(cells, problem); }).first == Status::badArgument);
  problem.boundary = boundaryOf(cells);
  problem.source.assign(3, 0);
  CHECK(refusal([&] { poissonSystem(cells, problem); }).first == Status::badArgument);
  problem.source.assign(cells.cellCount(), 0);
  problem.source[5] = NAN;
  CHECK(refusal([&] { poissonSystem(cells, problem); }).second == 5);
  problem.source.clear();
  problem.boundary.value[7] = INFINITY;
  CHECK(refusal([&] { poissonSystem(cells, problem); }).second == problem.boundary.halfFaces[7]);
  problem.boundary.value.pop_back();
  CHECK(refusal([&] { poissonSystem(cells, problem); }).first == Status::badArgument);
}
