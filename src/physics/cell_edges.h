// Which dual edges the cells have.
#pragma once

#include "physics/dual_edges.h"

namespace mandoline::physics {

/// Per cell its dual edges, ascending.
MANDOLINE_SHARED detail::Csr<uint32_t> cellEdges(const CellComplex& cells, const DualEdges& dual, unsigned threads);

}  // namespace mandoline::physics
