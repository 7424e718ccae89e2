// The order of untouched grid cells in a cell complex: which of the whole come before those of some layers, found from the runs alone.
#pragma once

#include "base/shared.h"
#include "mandoline/coarsen.h"

namespace mandoline::detail {

/// Of untouched grid cells that follow each other in Morton order.
struct UntouchedCounts {
  uint64_t cells = 0;
  uint64_t inner = 0;               ///< faces between two of them, each counted for the one that comes first
  std::array<uint64_t, 6> sides{};  ///< faces in a side of the grid, as in FaceTag

  uint64_t faces() const;
  void add(const UntouchedCounts& other);
};

struct UntouchedOrder {
  OctreeCells cells;                    ///< those of the layers, each by itself
  std::vector<UntouchedCounts> before;  ///< per cell: of the whole's cells before it
  UntouchedCounts all;                  ///< of the whole
};

/// `cutMesh` has the runs of the whole. The order of coarsen() with maxLevel 0. Takes time in proportion to the grid cells of the layers,
/// and to the rows of the grid.
MANDOLINE_SHARED UntouchedOrder untouchedOrder(const CutMesh& cutMesh, const std::array<int64_t, 2>& layers);

}  // namespace mandoline::detail
