// How matrices are made. Entries are added here and not by Eigen, so that a program that compiles its templates with other flags can't
// change the sums.
#pragma once

#include <span>
#include <vector>

#include "physics/dual_edges.h"

namespace mandoline::physics {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Entries in one place are added in their order.
CsrMatrix assembleRows(size_t rows, size_t columns, const Triplets& entries);
SparseMatrix assemble(size_t rows, size_t columns, const Triplets& entries);

struct LaplacianTerms {
  double factor;
  std::span<const double> added;  ///< per row: what is added to the diagonal; empty for nothing
};

/// The Laplacian, div k grad, times a factor, plus what is added. `edgesOfCells`: cellEdges().
CsrMatrix laplacianRows(const CellComplex& cells, const DualEdges& dual, const detail::Csr<uint32_t>& edgesOfCells,
                        const LaplacianTerms& terms, unsigned threads);

}  // namespace mandoline::physics
