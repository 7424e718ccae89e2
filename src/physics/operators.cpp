#include "mandoline/operators.h"

#include "physics/cell_edges.h"
#include "physics/dual_edges.h"
#include "physics/sparse.h"

namespace mandoline {
namespace {

using physics::assemble;
using physics::DualEdge;
using physics::DualEdges;
using physics::dualEdges;
using physics::Triplets;

SparseMatrix diagonal(const std::vector<double>& values) {
  SparseMatrix matrix(Eigen::Index(values.size()), Eigen::Index(values.size()));
  matrix.reserve(Eigen::VectorXi::Constant(Eigen::Index(values.size()), 1));
  for (size_t i = 0; i < values.size(); ++i) matrix.insert(Eigen::Index(i), Eigen::Index(i)) = values[i];
  matrix.makeCompressed();
  return matrix;
}

/// Per face f(area, distance of the dual points), or 0 without a dual edge.
template <class F>
SparseMatrix diagonalOfFaces(const CellComplex& cells, DualPoints dualPoints, const F& f) {
  std::vector<double> values(cells.faceCount());
  const DualEdges dual = dualEdges(cells, dualPoints);
  for (size_t e = 0; e < dual.edges.size(); ++e) {
    for (const uint32_t face : dual.faces[e]) values[face] = f(cells.faceArea[face], dual.edges[e].distance);
  }
  return diagonal(values);
}

}  // namespace

SparseMatrix gradient(const CellComplex& cells, DualPoints dualPoints) {
  const DualEdges dual = dualEdges(cells, dualPoints);
  Triplets entries;
  for (size_t e = 0; e < dual.edges.size(); ++e) {
    const DualEdge& edge = dual.edges[e];
    const double perLength = edge.sign / edge.distance;
    for (const uint32_t f : dual.faces[e]) {
      entries.emplace_back(int(f), int(edge.cell), -perLength);
      for (const uint32_t other : dual.faces[e]) {
        const double share = physics::shareOf(cells, dual, e, other);
        entries.emplace_back(int(f), int(otherCell(cells, edge, other)), share * perLength);
      }
    }
  }
  return assemble(cells.faceCount(), cells.cellCount(), entries);
}

SparseMatrix divergence(const CellComplex& cells) {
  SparseMatrix matrix = cellFaceIncidence(cells);
  for (Eigen::Index f = 0; f < matrix.outerSize(); ++f) {
    for (SparseMatrix::InnerIterator entry(matrix, f); entry; ++entry) entry.valueRef() *= cells.faceArea[size_t(f)];
  }
  return matrix;
}

SparseMatrix laplacian(const CellComplex& cells, DualPoints dualPoints) {
  const DualEdges dual = dualEdges(cells, dualPoints);
  const CsrMatrix matrix = physics::laplacianRows(cells, dual, physics::cellEdges(cells, dual, 1), {1, {}}, 1);
  return EigenRows(matrix).map();
}

SparseMatrix cellMass(const CellComplex& cells) { return diagonal(cells.cellVolume); }

SparseMatrix faceStar(const CellComplex& cells, DualPoints dualPoints) {
  return diagonalOfFaces(cells, dualPoints, [](double area, double distance) { return area / distance; });
}

SparseMatrix faceMass(const CellComplex& cells, DualPoints dualPoints) {
  return diagonalOfFaces(cells, dualPoints, [](double area, double distance) { return area * distance; });
}

}  // namespace mandoline
