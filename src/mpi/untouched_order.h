// The order of untouched grid cells, or octree cells, in a cell complex: which of the whole come before those of some layers.
#pragma once

#include "base/shared.h"
#include "mandoline/coarsen.h"

namespace mandoline::detail {

/// Of untouched grid cells or octree cells that follow each other in Morton order.
struct UntouchedCounts {
  uint64_t cells = 0;
  uint64_t faces = 0;  ///< one between two of them counts for the smaller one, whose side it is, or of two alike for the first
};

struct UntouchedOrder {
  OctreeCells cells;                    ///< those of the layers, each by itself
  std::vector<UntouchedCounts> before;  ///< per cell: of the whole's cells before it
  UntouchedCounts all;                  ///< of the whole
  /// Per octree cell, whether the face below it is its side; none of grid cells, of which none is.
  std::vector<uint8_t> hasLower;
};

/// `cutMesh` has the runs of the whole. The order of coarsen() with maxLevel 0. Takes time in proportion to the grid cells of the layers,
/// and to the rows of the grid.
MANDOLINE_SHARED UntouchedOrder untouchedOrder(const CutMesh& cutMesh, const std::array<int64_t, 2>& layers);

/// The same of those octree cells of the whole that have grid cells of the layers; `whole` has them all.
MANDOLINE_SHARED UntouchedOrder octreeOrder(const OctreeCells& whole, const std::array<int64_t, 2>& layers);

}  // namespace mandoline::detail
