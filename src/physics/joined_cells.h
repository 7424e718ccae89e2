// Which cells are connected.
#pragma once

#include "base/disjoint_sets.h"
#include "mandoline/poisson.h"
#include "physics/dual_edges.h"

namespace mandoline::physics {

/// The components of cells joined through inner faces with isOpen(face), in the order of their first cells.
template <class IsOpen>
CellComponents joinedCells(const CellComplex& cells, const IsOpen& isOpen) {
  detail::DisjointSets sets(cells.cellCount());
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    if (isInner(cells, f) && isOpen(f)) sets.unite(uint32_t(cells.faceCells[2 * f]), uint32_t(cells.faceCells[2 * f + 1]));
  }
  CellComponents result;
  for (uint32_t c = 0; c < cells.cellCount(); ++c) {
    const uint32_t first = sets.find(c);
    result.cellComponent.push_back(first == c ? result.count++ : result.cellComponent[first]);
  }
  return result;
}

}  // namespace mandoline::physics
