// How matrices are made: Eigen stores them and adds what falls in one place, all other arithmetic is here, so that flags of a program that
// uses the same templates of Eigen can't change it.
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

/// Adds the Laplacian times a factor.
void addLaplacian(const CellComplex& cells, const DualEdges& dual, double factor, Triplets& entries);

}  // namespace mandoline::physics
