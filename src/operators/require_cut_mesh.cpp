#include "operators/require_cut_mesh.h"

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

}  // namespace mandoline::operators
