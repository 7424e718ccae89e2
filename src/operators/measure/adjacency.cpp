// Adjacency of a cut-mesh: the two owners of each face, and the cut-cells beside each cut-cell.
#include <algorithm>

#include "mandoline/measure.h"

namespace mandoline {
namespace {

/// Index of the grid cell across an axial face from the cut-cell on one of its sides, or -1 outside of the grid.
int64_t gridCellAcross(const CutMesh& cutMesh, size_t face, size_t cell) {
  const int axis = cutMesh.faceAxis[face];
  std::array<int64_t, 3> at;
  for (int d = 0; d < 3; ++d) at[d] = cutMesh.cellGridCell[3 * cell + d];
  at[axis] = 2 * int64_t(cutMesh.facePlane[face]) - 1 - at[axis];  // the plane's index is that of the cell above it
  if (at[axis] < 0 || at[axis] >= cutMesh.grid.cells(axis)) return -1;
  return at[0] + cutMesh.grid.cells(0) * (at[1] + cutMesh.grid.cells(1) * at[2]);
}

void findOwners(const CutMesh& cutMesh, Adjacency& result) {
  result.faceCells.assign(2 * cutMesh.faceCount(), -1);
  result.faceGridCells.assign(2 * cutMesh.faceCount(), -1);
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) result.faceCells[h] = int32_t(c);
  }
  for (size_t h = 0; h < result.faceCells.size(); ++h) {
    const int32_t opposite = result.faceCells[h ^ 1];
    if (result.faceCells[h] < 0 && opposite >= 0 && cutMesh.faceAxis[h / 2] >= 0) {
      result.faceGridCells[h] = gridCellAcross(cutMesh, h / 2, size_t(opposite));
    }
  }
}

}  // namespace

Adjacency adjacency(const CutMesh& cutMesh) {
  Adjacency result;
  findOwners(cutMesh, result);
  result.cellCellOffsets.assign(1, 0);
  result.cellCellOffsets.reserve(cutMesh.cellCount() + 1);
  result.cellCells.reserve(cutMesh.cellHalfFaces.size());
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    const auto first = std::ptrdiff_t(result.cellCells.size());
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      const int32_t neighbour = result.faceCells[h ^ 1];
      if (neighbour >= 0 && size_t(neighbour) != c) result.cellCells.push_back(uint32_t(neighbour));
    }
    std::sort(result.cellCells.begin() + first, result.cellCells.end());
    result.cellCells.erase(std::unique(result.cellCells.begin() + first, result.cellCells.end()), result.cellCells.end());
    result.cellCellOffsets.push_back(uint32_t(result.cellCells.size()));
  }
  return result;
}

}  // namespace mandoline
