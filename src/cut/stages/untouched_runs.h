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
};

UntouchedRuns findUntouchedRuns(const Input& input, const Bricks& bricks, Monitor& monitor);

}  // namespace mandoline::detail
