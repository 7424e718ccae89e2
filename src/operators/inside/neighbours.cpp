#include "operators/inside/neighbours.h"

#include <algorithm>

namespace mandoline::operators {

void forEachNeighbours(const CutMesh& cutMesh, const OctreeCells& octree, const std::vector<int32_t>& owners,
                       detail::FunctionRef<void(uint32_t, uint32_t)> f) {
  using GridCell = std::array<int32_t, 3>;
  const auto firstOctree = uint32_t(cutMesh.cellCount());
  for (size_t face = 0; face < cutMesh.faceCount(); ++face) {
    const int32_t below = owners[2 * face], above = owners[2 * face + 1], cell = std::max(below, above);
    if (cutMesh.faceTriangle[face] >= 0 || cell < 0) continue;
    if (below >= 0 && above >= 0) {
      f(uint32_t(below), uint32_t(above));
      continue;
    }
    const int32_t* gridCell = &cutMesh.cellGridCell[3 * size_t(cell)];
    GridCell at = {gridCell[0], gridCell[1], gridCell[2]};
    at[size_t(cutMesh.faceAxis[face])] += below >= 0 ? 1 : -1;
    const int64_t other = octree.find(at[0], at[1], at[2]);
    if (other >= 0) f(uint32_t(cell), firstOctree + uint32_t(other));
  }
  for (size_t c = 0; c < octree.cellCount(); ++c) {
    const GridCell corner = octree.corner(c), end = octree.end(c);
    for (size_t d = 0; d < 3; ++d) {
      for (const bool isUpper : {false, true}) {
        GridCell at = corner;
        at[d] = isUpper ? end[d] : corner[d] - 1;
        const int64_t other = octree.find(at[0], at[1], at[2]);  // where smaller cells lie they find this one
        if (other >= 0) f(firstOctree + uint32_t(c), firstOctree + uint32_t(other));
      }
    }
  }
}

}  // namespace mandoline::operators
