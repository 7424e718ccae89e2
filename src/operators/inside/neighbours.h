// Which cut-cells and octree cells are neighbours through faces that are not pieces of triangles.
#pragma once

#include "base/function_ref.h"
#include "mandoline/coarsen.h"

namespace mandoline::operators {

/// Calls f(a, b) for each two neighbours, some of them several times. Numbers are those of cut-cells, then of octree cells. `owners`: of
/// half-faces.
void forEachNeighbours(const CutMesh& cutMesh, const OctreeCells& octree, const std::vector<int32_t>& owners,
                       detail::FunctionRef<void(uint32_t, uint32_t)> f);

}  // namespace mandoline::operators
