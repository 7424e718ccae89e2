// The regions of refined cells, which are those of the grid's cut.
#pragma once

#include "operators/refine/assembly.h"

namespace mandoline::refining {

/// What there is of the leaves.
struct Sources {
  const OctreeCells& leaves;
  const Parts& parts;
  const SharedIds& ids;
  const CutMesh& whole;  ///< the cut of the grid
};

/// Per cell: its region in the grid's cut. `cells` has faces and volumes.
std::vector<uint32_t> findRegions(const CellComplex& cells, const Assembled& assembled, const Sources& sources);

}  // namespace mandoline::refining
