// Which cut-cells are beside a face.
#pragma once

#include "mandoline/cut_mesh.h"

namespace mandoline::operators {

/// Per half-face: the cut-cell, or -1.
std::vector<int32_t> ownersOf(const CutMesh& cutMesh);

}  // namespace mandoline::operators
