// Regions and winding numbers (not in the paper): connected components of cut-cells and untouched grid cells, joined through faces that are
// not pieces of triangles; and the winding number of each, or what there is of it, stepping by one across every tri-cut-face from an exact
// value in one place.
//
// In: BrickCuts, BrickSeams, UntouchedRuns. Out: Regions. Components of bricks are joined over seams and through untouched grid cells.
#pragma once

#include <vector>

#include "cut/stages/seams.h"

namespace mandoline::detail {

struct Regions {
  IdVector<BrickId, std::vector<uint32_t>> ofComponents;  ///< per component of each brick
  std::vector<uint32_t> runRegion;                        ///< per run of untouched grid cells
  uint32_t count = 0;
  bool hasWinding = false;           ///< closed and consistently oriented
  std::vector<int32_t> winding;      ///< per region, empty unless hasWinding
  std::vector<int32_t> partWinding;  ///< of parts that have it; empty if hasWinding, or if none has
  std::vector<uint8_t> parity;       ///< of parts that have parity; likewise
};

/// Numbers regions in the order of their first grid cells.
Regions findRegions(const CutBricks& cut);

}  // namespace mandoline::detail
