// The untouched grid cells, as runs along x: memory by run, not by cell.
#pragma once

#include "cut/stages/bricks.h"

namespace mandoline::detail {

struct UntouchedRuns {
  std::vector<uint32_t> rowOffsets;  ///< per row of grid cells (k ny + j), and one more: into runs
  std::vector<int32_t> begin, end;   ///< per run: along x, half open
  size_t ny = 0;

  size_t size() const { return begin.size(); }
  size_t rowOf(const Slab& cell) const { return size_t(cell[2] >> 1) * ny + size_t(cell[1] >> 1); }
  /// The run that holds an untouched grid cell.
  uint32_t at(const Slab& cell) const {
    const size_t row = rowOf(cell);
    const auto first = end.begin() + ptrdiff_t(rowOffsets[row]), past = end.begin() + ptrdiff_t(rowOffsets[row + 1]);
    return uint32_t(std::upper_bound(first, past, cell[0] >> 1) - end.begin());
  }
  /// Calls f(run, run) for those that lie beside each other along y and z.
  template <class F>
  void forNeighbours(const F& f) const {
    const auto forRows = [&](size_t r, size_t s) {
      for (uint32_t a = rowOffsets[r], b = rowOffsets[s]; a < rowOffsets[r + 1] && b < rowOffsets[s + 1];) {
        if (std::max(begin[a], begin[b]) < std::min(end[a], end[b])) f(a, b);
        end[a] < end[b] ? ++a : ++b;
      }
    };
    for (size_t r = 0; r + 1 < rowOffsets.size(); ++r) {
      if (r % ny > 0) forRows(r - 1, r);
      if (r >= ny) forRows(r - ny, r);
    }
  }
};

/// `layers`: other rows have no runs.
UntouchedRuns findUntouchedRuns(const Input& input, const Bricks& bricks, const CellLayers& layers, Monitor& monitor);

}  // namespace mandoline::detail
