// Sparse matrices by rows, as solvers outside of this library take them: library mandoline::operators. Needs no Eigen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mandoline/api.h"

namespace MANDOLINE_API mandoline {

/// Row r has entries rowOffsets[r] .. rowOffsets[r + 1] - 1, at most one per column. PETSc (MatCreateSeqAIJWithArrays), hypre, AMGCL
/// (std::tie of rows and the three arrays) and SciPy (csr_matrix) take these arrays, where need be converted to the widths of their
/// integers; EigenRows of operators.h shows them to Eigen.
struct CsrMatrix {
  size_t columns = 0;                     ///< how many there are
  std::vector<int64_t> rowOffsets = {0};  ///< into the entries, per row, and their number at the end
  std::vector<int32_t> entryColumns;      ///< per entry: its column, ascending in each row
  std::vector<double> entryValues;        ///< per entry

  size_t rows() const { return rowOffsets.size() - 1; }
  size_t entryCount() const { return entryValues.size(); }
};

}  // namespace mandoline
