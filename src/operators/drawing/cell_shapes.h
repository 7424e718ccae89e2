// Volumes and centroids of cut-cells for pictures, from the triangles that are drawn: a fraction of the work of measure(), which is
// accurate however thin a cell is.
#pragma once

#include "mandoline/drawing.h"
#include "mandoline/triangulate.h"

namespace mandoline::drawing {

/// Fills in those of `out`.
void measureCells(const CutMesh& cutMesh, const FaceTriangles& faceTriangles, const std::array<double, 3>& origin, CellDrawing& out);

}  // namespace mandoline::drawing
