// mergeSmallCells() in two steps, for cells that several processes have a part of each.
#pragma once

#include <array>
#include <span>

#include "base/shared.h"
#include "mandoline/merge.h"

namespace mandoline::operators {

/// Whether a cell may have a face through which small cells join others: all that mergeSmallCells() looks at are the half-faces of these.
/// `most`: the volume of the largest grid cell.
inline bool mayJoin(const CellComplex& cells, size_t cell, double most, double fraction) {
  return cell < cells.cutCells && cells.cellVolume[cell] < fraction * most;
}
MANDOLINE_SHARED double largestGridCell(const Grid& grid);

/// Per cell the first of those that it becomes one with. Of the cells the arrays of vertices and loops are not needed, nor of faces those
/// of cells that may not join others, their centroids, or of cells their centres. Arguments are not checked.
MANDOLINE_SHARED std::vector<uint32_t> mergedWith(const CutMesh& cutMesh, const CellComplex& cells, const MergeOptions& options);

/// Merges pairs of cells, whatever they are like. Arguments are not checked; the result has no fingerprints.
MANDOLINE_SHARED MergedCells mergePairs(const CutMesh& cutMesh, const CellComplex& cells, std::span<const std::array<uint32_t, 2>> pairs,
                                        const MergeOptions& options);

}  // namespace mandoline::operators
