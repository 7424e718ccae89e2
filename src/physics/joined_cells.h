// Which cells are connected.
#pragma once

#include "base/large_array.h"
#include "base/shared_sets.h"
#include "mandoline/poisson.h"
#include "physics/dual_edges.h"
#include "physics/node_loops.h"

namespace mandoline::physics {

/// The components of cells joined through inner faces with isOpen(face), in the order of their first cells.
template <class IsOpen>
CellComponents joinedCells(const CellComplex& cells, const detail::Team& team, const IsOpen& isOpen) {
  detail::SharedSets sets(cells.cellCount());
  forBlocks(cells.faceCount(), team, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      if (isInner(cells, f) && isOpen(f)) sets.unite(uint32_t(cells.faceCells[2 * f]), uint32_t(cells.faceCells[2 * f + 1]));
    }
  });
  CellComponents result;
  detail::reserveLarge(result.cellComponent, cells.cellCount());
  for (uint32_t c = 0; c < cells.cellCount(); ++c) {
    const uint32_t first = sets.find(c);
    result.cellComponent.push_back(first == c ? result.count++ : result.cellComponent[first]);
  }
  return result;
}

/// cellComponents() on all threads.
inline CellComponents componentsOf(const CellComplex& cells, const detail::Team& team) {
  return joinedCells(cells, team, [](size_t) { return true; });
}

}  // namespace mandoline::physics
