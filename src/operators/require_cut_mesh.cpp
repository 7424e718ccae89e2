#include "operators/require_cut_mesh.h"

#include <algorithm>

namespace mandoline::operators {

void refuse(const std::string& message, int64_t element) { throw CallError({Status::badArgument, element, -1, message}); }

void requireCutMesh(const CutMesh& cutMesh) {
  if (cutMesh.rowRunOffsets.empty()) refuse("The cut-mesh is empty: cut() makes one.");
}

void refuseCells() { refuse("The cells are not all of this cut-mesh's."); }

void requireCellsOf(const CutMesh& cutMesh, const CellComplex& cells) {
  const std::vector<double>&own = cutMesh.positions, &all = cells.positions;
  const bool same = cells.cutCells == cutMesh.cellCount() && cells.cutFaces == cutMesh.faceCount() &&
                    cells.cutVertices == cutMesh.vertexCount() && own.size() <= all.size() &&
                    std::equal(own.begin(), own.end(), all.begin());
  if (!same) refuseCells();
}

}  // namespace mandoline::operators
