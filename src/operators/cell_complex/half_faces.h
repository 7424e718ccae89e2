// Which half-faces the cells of a complex have.
#pragma once

#include "base/csr.h"
#include "base/large_array.h"
#include "mandoline/cell_complex.h"

namespace mandoline::operators {

/// Fills in cellHalfFaces and their offsets, from faceCells.
inline void gatherHalfFaces(CellComplex& cells) {
  std::vector<uint32_t>& offsets = cells.cellHalfFaceOffsets;
  offsets.clear();
  detail::makeLarge(offsets, cells.cellCount() + 1);
  for (const int32_t cell : cells.faceCells) {
    if (cell >= 0) ++offsets[size_t(cell)];
  }
  detail::makeLarge(cells.cellHalfFaces, detail::toOffsets(offsets));
  for (uint32_t h = 0; h < cells.faceCells.size(); ++h) {
    const int32_t cell = cells.faceCells[h];
    if (cell >= 0) cells.cellHalfFaces[offsets[size_t(cell)]++] = h;
  }
  detail::moveBack(offsets);
}

}  // namespace mandoline::operators
