// Discrete operators on a cell complex, as sparse matrices of Eigen: library mandoline::operators.
//
// Rows and columns are the ids of cells, faces, edges and vertices. A field u on faces has a value per face, its mean component along the
// face's normal, which points from the cell on side 0 to that on side 1; phi on cells has a value per cell, that at its dual point.
// Fluxes pass only through faces of tag inner that have two cells: the two sides of a sheet never meet in a row.
#pragma once

#include <Eigen/SparseCore>

#include "mandoline/cell_complex.h"
#include "mandoline/csr_matrix.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// A matrix as Eigen sees it, for as long as both live. Columns and values are read where they are; offsets are copied, since Eigen has
/// them as wide as columns. A matrix of 2^31 entries or more throws CallError{badArgument}.
class EigenRows {
 public:
  using Map = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>;

  explicit EigenRows(const CsrMatrix& matrix) : matrix_(matrix), offsets_(matrix.rowOffsets.begin(), matrix.rowOffsets.end()) {
    if (matrix.rowOffsets.back() > INT32_MAX)
      throw CallError({Status::badArgument, -1, -1, "The matrix has more entries than Eigen counts with 32 bits."});
  }
  explicit EigenRows(CsrMatrix&&) = delete;
  Map map() const {
    return {Eigen::Index(matrix_.rows()), Eigen::Index(matrix_.columns), Eigen::Index(matrix_.entryCount()), offsets_.data(),
            matrix_.entryColumns.data(),  matrix_.entryValues.data()};
  }

 private:
  const CsrMatrix& matrix_;
  std::vector<int32_t> offsets_;
};

/// Where a cell's value lies. What is said of errors holds for the operators; solvePoisson() corrects them.
enum class DualPoints : uint8_t {
  /// CellComplex::cellCentre (Azevedo et al. 2016; paper, appendix B). The line between two dual points is normal to the face that they
  /// share, so fluxes of linear fields are exact; merged cells have that of their base, which leaves an error of first order beside them.
  centres,
  /// CellComplex::cellCentroid. Beside cut-cells the line is slanted, which leaves an error of first order.
  centroids
};

/// The edges of all faces.
struct ComplexEdges {
  std::vector<uint32_t> vertices;  ///< 2 per edge, the lower id first; edges ascend by the first, then by the second
  Fingerprint madeFrom;            ///< of the cell complex

  size_t count() const { return vertices.size() / 2; }

  static void fields(auto& self, const auto& f) {
    f("vertices", self.vertices);
    f("madeFrom", self.madeFrom);
  }
};
ComplexEdges complexEdges(const CellComplex& cells);

// Signed incidences, of entries 1 and -1. The product of one with the next is zero to the bit. `edges` are complexEdges(cells); those of
// other cells throw CallError{badArgument}.

/// Cells x faces: 1 if the face's normal points out of the cell, -1 if into it; none for a face with the cell on both sides.
SparseMatrix cellFaceIncidence(const CellComplex& cells);
/// Faces x edges: 1 if the face is on the left of the edge that runs from its lower to its higher vertex, seen against the face's normal;
/// -1 if on the right; none for an edge with the face on both sides.
SparseMatrix faceEdgeIncidence(const CellComplex& cells, const ComplexEdges& edges);
/// Edges x vertices: -1 for the lower vertex, 1 for the higher.
SparseMatrix edgeVertexIncidence(const CellComplex& cells, const ComplexEdges& edges);

/// Faces x cells: phi to its derivative along the face's normal: the difference of the values on both sides over the distance of their dual
/// points along the normal. Where one cell meets smaller ones, the other value is the mean of theirs by area, for each of these faces,
/// so that linear fields are exact there, too. (Beside a sliver this is of first order only: keep a fine layer, see CoarsenOptions.) Rows
/// of other faces, the boundary's, are empty.
SparseMatrix gradient(const CellComplex& cells, DualPoints dualPoints = DualPoints::centres);
/// Cells x faces: u to the outflow of the cell, the integral of its divergence: incidence times area. Zero up to rounding for a constant
/// field, u = U . faceNormal.
SparseMatrix divergence(const CellComplex& cells);
/// Cells x cells: divergence * gradient; symmetric, rows have the sum zero: the integral over the cell of phi's Laplacian if nothing flows
/// through the boundary. Negative semidefinite.
SparseMatrix laplacian(const CellComplex& cells, DualPoints dualPoints = DualPoints::centres);

// Diagonal.

/// Cells x cells: volumes, the mass matrix of cells; its inverse is the Hodge star from integrals over cells to values at dual points.
SparseMatrix cellMass(const CellComplex& cells);
/// Faces x faces: area over distance of the dual points, the Hodge star from integrals along dual edges to fluxes; 0 for faces without
/// a dual edge. The Laplacian is -incidence * star * incidence^T where no cell meets smaller ones.
SparseMatrix faceStar(const CellComplex& cells, DualPoints dualPoints = DualPoints::centres);
/// Faces x faces: area times distance of the dual points, the mass matrix of u; 0 for faces without a dual edge.
SparseMatrix faceMass(const CellComplex& cells, DualPoints dualPoints = DualPoints::centres);

}  // namespace mandoline
