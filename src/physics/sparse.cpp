#include "physics/sparse.h"

#include <numeric>
#include <span>

#include "base/large_array.h"
#include "base/parallel.h"
#include "base/sort.h"

namespace mandoline::physics {

namespace {

struct Entry {
  int32_t column;
  double value;
};

/// Appends a row. Entries in one place are added in their order.
void appendRow(std::span<Entry> entries, CsrMatrix& matrix) {
  detail::sortItems(entries, [](const Entry& a, const Entry& b) { return a.column < b.column; });
  const size_t first = matrix.entryCount();
  for (const auto& [column, value] : entries) {
    if (matrix.entryCount() > first && matrix.entryColumns.back() == column) {
      matrix.entryValues.back() += value;
      continue;
    }
    matrix.entryColumns.push_back(column);
    matrix.entryValues.push_back(value);
  }
  matrix.rowOffsets.push_back(int64_t(matrix.entryCount()));
}

/// f(row, column, value) for each entry that a dual edge adds to the Laplacian times a factor.
template <class F>
void forEntries(const CellComplex& cells, const DualEdges& dual, size_t e, double factor, const F& f) {
  const DualEdge& edge = dual.edges[e];
  const double all = factor * edge.flow / edge.distance;
  const auto share = [&](uint32_t face) { return shareOf(cells, dual, e, face); };
  f(edge.cell, edge.cell, -all);
  for (const uint32_t face : dual.faces[e]) {
    const uint32_t other = otherCell(cells, edge, face);
    f(edge.cell, other, share(face) * all);
    f(other, edge.cell, share(face) * all);
    for (const uint32_t g : dual.faces[e]) f(other, otherCell(cells, edge, g), -share(face) * share(g) * all);
  }
}

/// The rows of all, on all threads.
CsrMatrix joined(std::vector<CsrMatrix> parts, size_t columns, detail::Monitor& monitor) {
  CsrMatrix matrix;
  if (parts.size() == 1) matrix = std::move(parts[0]);
  matrix.columns = columns;
  if (parts.size() == 1) return matrix;
  std::vector<size_t> begins;  // entries
  for (const CsrMatrix& part : parts) {
    const auto begin = size_t(matrix.rowOffsets.back());
    begins.push_back(begin);
    for (size_t r = 1; r <= part.rows(); ++r) matrix.rowOffsets.push_back(int64_t(begin) + part.rowOffsets[r]);
  }
  detail::makeLargeOnThreads(matrix.entryColumns, size_t(matrix.rowOffsets.back()), monitor.threads());
  detail::makeLargeOnThreads(matrix.entryValues, size_t(matrix.rowOffsets.back()), monitor.threads());
  std::vector<uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0u);
  detail::runItems(order, monitor, [&](size_t, uint32_t p) {
    std::copy(parts[p].entryColumns.begin(), parts[p].entryColumns.end(), matrix.entryColumns.begin() + ptrdiff_t(begins[p]));
    std::copy(parts[p].entryValues.begin(), parts[p].entryValues.end(), matrix.entryValues.begin() + ptrdiff_t(begins[p]));
  });
  return matrix;
}

}  // namespace

CsrMatrix assembleRows(size_t rows, size_t columns, const Triplets& entries) {
  std::vector<size_t> ends(rows + 1);  // first where the next entry of a row goes
  for (const auto& entry : entries) ++ends[size_t(entry.row()) + 1];
  for (size_t r = 0; r < rows; ++r) ends[r + 1] += ends[r];
  std::vector<Entry> sorted(entries.size());
  for (const auto& entry : entries) sorted[ends[size_t(entry.row())]++] = {entry.col(), entry.value()};

  CsrMatrix matrix;
  matrix.columns = columns;
  matrix.rowOffsets.reserve(rows + 1);
  for (size_t r = 0, begin = 0; r < rows; begin = ends[r++]) appendRow(std::span(sorted.data() + begin, ends[r] - begin), matrix);
  return matrix;
}

SparseMatrix assemble(size_t rows, size_t columns, const Triplets& entries) {
  const CsrMatrix matrix = assembleRows(rows, columns, entries);
  return EigenRows(matrix).map();
}

CsrMatrix laplacianRows(const CellComplex& cells, const DualEdges& dual, const detail::Csr<uint32_t>& edgesOfCells,
                        const LaplacianTerms& terms, unsigned threads) {
  struct Part {
    CsrMatrix rows;
    std::vector<Entry> row;
  };
  detail::Monitor monitor(threads);
  std::vector<Part> parts = detail::forChunks<Part>(cells.cellCount(), monitor, [&](Part& part, size_t begin, size_t end) {
    for (size_t c = begin; c < end; ++c) {
      part.row.clear();
      for (const uint32_t e : edgesOfCells[c]) {
        forEntries(cells, dual, e, terms.factor, [&](uint32_t row, uint32_t column, double value) {
          if (row == c) part.row.push_back({int32_t(column), value});
        });
      }
      if (!terms.added.empty() && terms.added[c] > 0) part.row.push_back({int32_t(c), terms.added[c]});
      appendRow(part.row, part.rows);
    }
  });
  std::vector<CsrMatrix> rows;
  for (Part& part : parts) rows.push_back(std::move(part.rows));
  return joined(std::move(rows), cells.cellCount(), monitor);
}

}  // namespace mandoline::physics
