#include "physics/sparse.h"

#include <span>

#include "base/sort.h"

namespace mandoline::physics {

CsrMatrix assembleRows(size_t rows, size_t columns, const Triplets& entries) {
  struct Entry {
    int32_t column;
    double value;
  };
  std::vector<size_t> ends(rows + 1);  // first where the next entry of a row goes
  for (const auto& entry : entries) ++ends[size_t(entry.row()) + 1];
  for (size_t r = 0; r < rows; ++r) ends[r + 1] += ends[r];
  std::vector<Entry> sorted(entries.size());
  for (const auto& entry : entries) sorted[ends[size_t(entry.row())]++] = {entry.col(), entry.value()};

  CsrMatrix matrix;
  matrix.columns = columns;
  matrix.rowOffsets.reserve(rows + 1);
  for (size_t r = 0, begin = 0; r < rows; begin = ends[r++]) {
    detail::sortItems(std::span(sorted.data() + begin, ends[r] - begin),
                      [](const Entry& a, const Entry& b) { return a.column < b.column; });
    const size_t first = matrix.entryCount();
    for (size_t e = begin; e < ends[r]; ++e) {
      const auto& [column, value] = sorted[e];
      if (matrix.entryCount() > first && matrix.entryColumns.back() == column) {
        matrix.entryValues.back() += value;
        continue;
      }
      matrix.entryColumns.push_back(column);
      matrix.entryValues.push_back(value);
    }
    matrix.rowOffsets.push_back(int64_t(matrix.entryCount()));
  }
  return matrix;
}

SparseMatrix assemble(size_t rows, size_t columns, const Triplets& entries) {
  const CsrMatrix matrix = assembleRows(rows, columns, entries);
  return EigenRows(matrix).map();
}

}  // namespace mandoline::physics
