// Winding numbers and parity of regions: the second half of regions.h.
#pragma once

#include "cut/stages/regions.h"

namespace mandoline::detail {

/// Sets winding numbers and parity of `regions`, whose regions are known.
void findWinding(const CutBricks& cut, Regions& regions);

}  // namespace mandoline::detail
