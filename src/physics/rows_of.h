// Rows of ids, found on all threads.
#pragma once

#include <utility>
#include <vector>

#include "base/csr.h"
#include "base/large_array.h"
#include "base/parallel.h"

namespace mandoline::physics {

/// f(r, row) appends the items of row r.
template <class F>
detail::Csr<uint32_t> rowsOf(size_t rows, unsigned threads, const F& f) {
  struct Part {
    detail::Csr<uint32_t> rows;
    std::vector<uint32_t> row;
  };
  detail::Monitor monitor(threads);
  std::vector<Part> parts = detail::forChunks<Part>(rows, monitor, [&](Part& part, size_t begin, size_t end) {
    for (size_t r = begin; r < end; ++r) {
      part.row.clear();
      f(r, part.row);
      part.rows.items.insert(part.rows.items.end(), part.row.begin(), part.row.end());
      part.rows.endGroup();
    }
  });
  if (parts.size() == 1) return std::move(parts[0].rows);
  detail::Csr<uint32_t> all;
  size_t count = 0;
  for (const Part& part : parts) count += part.rows.items.size();
  all.offsets.reserve(rows + 1);
  all.items.reserve(count);
  detail::getPages(all.offsets.data(), (rows + 1) * sizeof(uint32_t), threads);
  detail::getPages(all.items.data(), count * sizeof(uint32_t), threads);
  for (const Part& part : parts) all.append(part.rows);
  return all;
}

}  // namespace mandoline::physics
