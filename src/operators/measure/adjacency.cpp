// Adjacency of a cut-mesh: the two owners of each face, and the cut-cells beside each cut-cell.
#include <algorithm>

#include "base/sort.h"
#include "mandoline/measure.h"
#include "operators/measure/owners.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

/// Index of the grid cell across an axial face from the cut-cell on one of its sides, or -1 outside the grid.
int64_t gridCellAcross(const CutMesh& cutMesh, const Face& face, size_t cell) {
  std::array<int64_t, 3> at;
  for (size_t d = 0; d < 3; ++d) at[d] = cutMesh.cellGridCell[3 * cell + d];
  int64_t& across = at[size_t(face.axis)];
  across = 2 * int64_t(face.plane) - 1 - across;  // the plane's index is that of the cell above it
  if (across < 0 || across >= cutMesh.grid.cells(face.axis)) return -1;
  return at[0] + cutMesh.grid.cells(0) * (at[1] + cutMesh.grid.cells(1) * at[2]);
}

}  // namespace

std::vector<int32_t> operators::ownersOf(const CutMesh& cutMesh) {
  std::vector<int32_t> owners(2 * cutMesh.faceCount(), -1);
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) owners[h] = int32_t(c);
  }
  return owners;
}

std::vector<int64_t> operators::gridCellsBeside(const CutMesh& cutMesh, const std::vector<int32_t>& owners) {
  std::vector<int64_t> gridCells(owners.size(), -1);
  for (size_t h = 0; h < owners.size(); ++h) {
    const Face face = cutMesh.face(h / 2);
    const int32_t opposite = owners[h ^ 1];
    if (owners[h] < 0 && opposite >= 0 && face.axis >= 0) gridCells[h] = gridCellAcross(cutMesh, face, size_t(opposite));
  }
  return gridCells;
}

Adjacency adjacency(const CutMesh& cutMesh) {
  operators::refuseRefined(cutMesh);
  Adjacency result;
  result.faceCells = operators::ownersOf(cutMesh);
  result.faceGridCells = operators::gridCellsBeside(cutMesh, result.faceCells);
  result.cellCellOffsets.assign(1, 0);
  result.cellCellOffsets.reserve(cutMesh.cellCount() + 1);
  result.cellCells.reserve(cutMesh.cellHalfFaces.size());
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    const auto first = std::ptrdiff_t(result.cellCells.size());
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      const int32_t neighbour = result.faceCells[h ^ 1];
      if (neighbour >= 0 && size_t(neighbour) != c) result.cellCells.push_back(uint32_t(neighbour));
    }
    detail::sortItems(std::span<uint32_t>(result.cellCells.data() + first, result.cellCells.size() - size_t(first)));
    result.cellCells.erase(std::unique(result.cellCells.begin() + first, result.cellCells.end()), result.cellCells.end());
    result.cellCellOffsets.push_back(uint32_t(result.cellCells.size()));
  }
  return result;
}

}  // namespace mandoline
