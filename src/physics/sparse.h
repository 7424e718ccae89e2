// How matrices are made: Eigen stores them and adds entries at one place. All other arithmetic is here, so that a program that compiles the
// same templates of Eigen with other flags can't change it.
#pragma once

#include <vector>

#include "physics/dual_edges.h"

namespace mandoline::physics {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Entries in one place are added.
inline SparseMatrix assemble(size_t rows, size_t columns, const Triplets& entries) {
  SparseMatrix matrix{Eigen::Index(rows), Eigen::Index(columns)};
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// The same by rows. Entries in one place are added in their order.
CsrMatrix assembleRows(size_t rows, size_t columns, const Triplets& entries);

/// Adds the Laplacian, div k grad, times a factor.
void addLaplacian(const CellComplex& cells, const DualEdges& dual, double factor, Triplets& entries);

}  // namespace mandoline::physics
