// Which cut-cells and grid cells are beside a face.
#pragma once

#include "mandoline/cut_mesh.h"

namespace mandoline::operators {

/// Per half-face: the cut-cell, or -1.
std::vector<int32_t> ownersOf(const CutMesh& cutMesh);

/// Per half-face: the untouched grid cell i + nx (j + ny k), or -1.
std::vector<int64_t> gridCellsBeside(const CutMesh& cutMesh, const std::vector<int32_t>& owners);

}  // namespace mandoline::operators
