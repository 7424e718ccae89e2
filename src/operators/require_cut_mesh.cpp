#include "operators/require_cut_mesh.h"

#include <algorithm>
#include <cmath>

#include "mesh/fingerprints.h"

namespace mandoline::operators {

void refuse(const std::string& message, int64_t element) { throw CallError({Status::badArgument, element, -1, message}); }

void requireCutMesh(const CutMesh& cutMesh) {
  requireNotEmpty(cutMesh);
  refuseRefined(cutMesh);
}

void refuseRefined(const CutMesh& cutMesh) {
  if (isRefined(cutMesh)) refuse("The cut-mesh is that of refined cells, which only functions that take both have a use for.");
}

void requireNotEmpty(const CutMesh& cutMesh) {
  if (cutMesh.loopOffsets.empty() && cutMesh.rowRunOffsets.empty()) refuse("The cut-mesh is empty: cut() makes one.");
}

void requireMadeFrom(Fingerprint madeFrom, Fingerprint other, const char* message) {
  if (!detail::mayBeSame(madeFrom, other)) refuse(message);
}

void refuseCells() { refuse("The cells are not all of this cut-mesh's."); }

void requireCellsOf(const CutMesh& cutMesh, const CellComplex& cells) {
  const size_t cutCells = cutMesh.cellCount(), cutFaces = cutMesh.faceCount();
  const bool areCells =
      cells.cellMemberOffsets.empty() ? cells.cutCells == cutCells : cells.cutCells <= cutCells && cells.cellMembers.size() >= cutCells;
  const bool areFaces = cells.faceMemberOffsets.empty() ? cells.cutFaces == cutFaces : cells.cutFaces <= cutFaces;
  const bool areAll = areCells && areFaces && cells.cutVertices == cutMesh.vertexCount();
  if (!areAll || !detail::mayBeSame(cells.madeFrom, cutMesh.fingerprint)) refuseCells();
}

void requireLengths(const CellComplex& cells) {
  double size = 0;
  for (size_t i = 3; i < cells.positions.size(); ++i) size = std::max(size, std::fabs(cells.positions[i] - cells.positions[i % 3]));
  requireLength(size);
}

void requireLength(double size) {
  constexpr double kSmallest = 1e-70, kLargest = 1e70;
  if (size == 0 || (size >= kSmallest && size <= kLargest)) return;
  refuse("The cells must be between 1e-70 and 1e70 in size, the range in which doubles can compute on them.");
}

}  // namespace mandoline::operators
