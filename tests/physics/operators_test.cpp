// Identities of the discrete operators on a cell complex.
#include "mandoline/operators.h"

#include "case_list.h"
#include "checked_cut.h"
#include "complexes.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

const std::array<double, 3> kField = {0.75, -1.25, 0.5};

template <class F>
void onAllCases(const F& f) {
  for (const NamedCase& c : caseList()) {
    for (const int maxLevel : {0, 24}) {
      CAPTURE(c.name, maxLevel);
      f(complexOf(c.mesh, c.grid, maxLevel));
    }
  }
}

Grid gradedGrid() {
  return Grid::rectilinear({std::vector<double>{0, 0.5, 1.5, 3, 3.5, 6, 7}, {0, 1, 1.25, 2.5, 4, 6, 6.5}, {0, 2, 2.5, 3, 4.5, 5, 6}});
}

/// Adds up a row's entries.
Eigen::VectorXd rowSums(const SparseMatrix& matrix) { return matrix * Eigen::VectorXd::Ones(matrix.cols()); }

}  // namespace

TEST_CASE("operators: the boundary of a boundary is empty, to the bit", "[operators]") {
  onAllCases([](const CellComplex& cells) {
    const ComplexEdges edges = complexEdges(cells);
    const SparseMatrix faces = cellFaceIncidence(cells), loops = faceEdgeIncidence(cells, edges), ends = edgeVertexIncidence(cells, edges);
    CHECK(faces.nonZeros() > 0);
    CHECK(isZero(faces * loops));
    CHECK(isZero(loops * ends));
  });
}

TEST_CASE("operators: a constant field has no divergence in any cell", "[operators]") {
  onAllCases([](const CellComplex& cells) {
    const std::vector<double> field = products(kField, cells.faceNormal);
    const double size = sizeOf(cells);
    CHECK(largest(divergence(cells) * vectorOf(field)) <= 1e-14 * size * size);
  });
}

TEST_CASE("operators: the gradient of a linear field is exact, also where a large cell meets smaller ones", "[operators]") {
  const auto check = [](const CellComplex& cells) {
    const std::vector<double> phi = products(kField, cells.cellCentre);
    const Eigen::VectorXd u = gradient(cells) * vectorOf(phi);
    for (size_t f = 0; f < cells.faceCount(); ++f) {
      const bool isInner = cells.faceTag[f] == FaceTag::inner;
      CAPTURE(f);
      REQUIRE(std::fabs(u[Eigen::Index(f)] - (isInner ? dot(kField, cells.faceNormal, f) : 0)) <= 1e-13);
    }
  };
  onAllCases(check);
  const Mesh ball = shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2);
  check(complexOf(ball, gradedGrid()));
  check(complexOf(ball, gradedGrid(), 24));
  check(complexOf(shapes::icosphere({9, 5, 4}, 2.2, 2), unitGrid(33, 10, 7), 24));  // octree cells that the grid's sides cut
}

TEST_CASE("operators: the Laplacian is the gradient's divergence, symmetric, and takes constants to zero", "[operators]") {
  onAllCases([](const CellComplex& cells) {
    for (const DualPoints points : {DualPoints::centres, DualPoints::centroids}) {
      const SparseMatrix matrix = laplacian(cells, points), transposed = matrix.transpose(),
                         product = divergence(cells) * gradient(cells, points);
      const double scale = std::max(largest(Eigen::VectorXd(matrix.diagonal())), 1e-300);
      CHECK((matrix - transposed).norm() <= 1e-13 * scale);
      CHECK((matrix - product).norm() <= 1e-13 * scale * std::sqrt(double(cells.cellCount())));
      CHECK(largest(rowSums(matrix)) <= 1e-13 * scale);
      for (Eigen::Index c = 0; c < matrix.rows(); ++c) REQUIRE(matrix.coeff(c, c) <= 0);
    }
  });
}

TEST_CASE("operators: Hodge stars make the Laplacian of single grid cells, masses give volumes", "[operators]") {
  const CellComplex cells = complexOf(shapes::icosphere({3, 3, 3}, 1.9, 2), unitGrid(6));
  const SparseMatrix incidence = cellFaceIncidence(cells), transposed = incidence.transpose();
  const SparseMatrix product = incidence * faceStar(cells) * transposed;
  CHECK(isZero(SparseMatrix(product + laplacian(cells)).pruned(1, 1e-15)));
  CHECK(rowSums(cellMass(cells)).sum() == Approx(216).epsilon(1e-13));
  const CellComplex empty = complexOf(shapes::cube(100, 101), unitGrid(4));
  CHECK(rowSums(faceMass(empty)).sum() == Approx(3 * 3 * 16));
}

TEST_CASE("operators: the two sides of a sheet are never coupled", "[operators]") {
  // A sheet that divides the grid's middle layer of cells but for its rim.
  const CellComplex cells = complexOf(shapes::quad({1, 1, 2.5}, {4, 1, 2.5}, {4, 4, 2.5}, {1, 4, 2.5}), unitGrid(5));
  const SparseMatrix matrix = laplacian(cells);
  std::vector<std::array<uint32_t, 2>> pairs;
  for (uint32_t a = 0; a < cells.cellCount(); ++a) {
    for (uint32_t b = a + 1; b < cells.cellCount(); ++b) {
      if (std::equal(&cells.cellCorner[3 * a], &cells.cellCorner[3 * a] + 3, &cells.cellCorner[3 * b])) pairs.push_back({a, b});
    }
  }
  REQUIRE(pairs.size() == 9);
  for (const auto& [a, b] : pairs) {
    CHECK(matrix.coeff(int(a), int(b)) == 0);
    CHECK(cells.cellRegion[a] == cells.cellRegion[b]);
  }
}

TEST_CASE("operators: the edges of other cells are refused", "[operators]") {
  const CellComplex cells = complexOf(shapes::icosphere({3, 3, 3}, 1.9, 1), unitGrid(6));
  const ComplexEdges own = complexEdges(cells);
  const auto requireRefused = [&](const ComplexEdges& edges) {
    CHECK(refusal([&] { faceEdgeIncidence(cells, edges); }).first == Status::badArgument);
    CHECK(refusal([&] { edgeVertexIncidence(cells, edges); }).first == Status::badArgument);
  };
  requireRefused(complexEdges(complexOf(shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 1), unitGrid(6))));
  ComplexEdges odd = own, more = own, beyond = own;
  odd.vertices.push_back(0);
  requireRefused(odd);
  more.vertices.insert(more.vertices.end(), {uint32_t(cells.vertexCount() - 1), uint32_t(cells.vertexCount())});
  requireRefused(more);
  beyond.vertices[1] = uint32_t(cells.vertexCount());
  requireRefused(beyond);
}

TEST_CASE("operators: edges from elsewhere have to be there", "[operators]") {
  const CellComplex cells = complexOf(shapes::icosphere({3, 3, 3}, 1.9, 1), unitGrid(6));
  const ComplexEdges own = complexEdges(cells);
  ComplexEdges less = own, swapped = own, last = own;
  less.vertices.resize(less.vertices.size() - 2);
  std::swap(swapped.vertices[0], swapped.vertices[1]);
  last.vertices.erase(last.vertices.begin(), last.vertices.begin() + 2);
  for (const ComplexEdges& edges : {ComplexEdges{}, less, swapped, last}) {
    CHECK(refusal([&] { faceEdgeIncidence(cells, edges); }).first == Status::badArgument);
    edgeVertexIncidence(cells, edges);
  }
}
