// Volumes of regions, added up cell by cell: to be the same to the bit, in the order of the cells, then of the runs.
#pragma once

#include "base/double_double.h"
#include "base/shared.h"
#include "mandoline/measure.h"

namespace mandoline::detail {

/// `sums`: per region.
MANDOLINE_SHARED void addCutCells(const CutMesh& cutMesh, const Measures& measures, std::vector<DoubleDouble>& sums);
MANDOLINE_SHARED void addUntouchedCells(const CutMesh& cutMesh, std::vector<DoubleDouble>& sums);

}  // namespace mandoline::detail
