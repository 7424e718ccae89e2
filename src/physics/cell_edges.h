// Which dual edges the cells have, and other rows of ids that are found on all threads.
#pragma once

#include "base/parallel.h"
#include "mandoline/status.h"
#include "physics/dual_edges.h"

namespace mandoline::physics {

/// f(r, row) appends the items of row r.
template <class F>
detail::Csr<uint32_t> rowsOf(size_t rows, unsigned threads, const F& f) {
  struct Part {
    detail::Csr<uint32_t> rows;
    std::vector<uint32_t> row;
  };
  const RunOptions quiet{threads, {}};
  detail::Monitor monitor(quiet, 1);
  std::vector<Part> parts = detail::forChunks<Part>(rows, monitor, [&](Part& part, size_t begin, size_t end) {
    for (size_t r = begin; r < end; ++r) {
      part.row.clear();
      f(r, part.row);
      part.rows.items.insert(part.rows.items.end(), part.row.begin(), part.row.end());
      part.rows.endGroup();
    }
  });
  detail::Csr<uint32_t> all = std::move(parts[0].rows);
  for (size_t p = 1; p < parts.size(); ++p) all.append(parts[p].rows);
  return all;
}

/// Per cell its dual edges, ascending.
detail::Csr<uint32_t> cellEdges(const CellComplex& cells, const DualEdges& dual, unsigned threads);

}  // namespace mandoline::physics
