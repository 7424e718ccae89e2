// Which half-faces the cells of a complex have.
#pragma once

#include "mandoline/cell_complex.h"

namespace mandoline::operators {

/// Fills in cellHalfFaces and their offsets, from faceCells.
inline void gatherHalfFaces(CellComplex& cells) {
  std::vector<uint32_t>& offsets = cells.cellHalfFaceOffsets;
  offsets.assign(cells.cellCount() + 1, 0);
  for (const int32_t cell : cells.faceCells) {
    if (cell >= 0) ++offsets[size_t(cell) + 1];
  }
  for (size_t c = 0; c < cells.cellCount(); ++c) offsets[c + 1] += offsets[c];
  cells.cellHalfFaces.resize(offsets.back());
  std::vector<uint32_t> next(offsets.begin(), offsets.end() - 1);
  for (uint32_t h = 0; h < cells.faceCells.size(); ++h) {
    const int32_t cell = cells.faceCells[h];
    if (cell >= 0) cells.cellHalfFaces[next[size_t(cell)]++] = h;
  }
}

}  // namespace mandoline::operators
