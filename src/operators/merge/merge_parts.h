// mergeSmallCells() in two steps and uniteWalls(), for cells that several processes have a part of each.
#pragma once

#include <array>
#include <span>

#include "base/shared.h"
#include "mandoline/merge.h"

namespace mandoline::operators {

/// Per cell the first of those that it becomes one with. Of vertices and loops no arrays are needed, nor the
/// centres of cells or the faces at the outside. Arguments are not checked.
MANDOLINE_SHARED std::vector<uint32_t> mergedWith(const CutMesh& cutMesh, const CellComplex& cells, const MergeOptions& options);

/// Merges pairs of cells, whatever they are like. Arguments are not checked; the result has no fingerprints.
MANDOLINE_SHARED MergedCells mergePairs(const CutMesh& cutMesh, const CellComplex& cells, std::span<const std::array<uint32_t, 2>> pairs,
                                        const MergeOptions& options);

/// As uniteWalls(). Arguments are not checked; the result has no fingerprint of its own.
MANDOLINE_SHARED CellComplex uniteWallsOf(const CutMesh& cutMesh, const CellComplex& cells, const WallOptions& options);

}  // namespace mandoline::operators
