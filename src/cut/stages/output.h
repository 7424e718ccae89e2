// Stage 9, output: compacts the vertices, lays the faces one after the other, and computes the coordinates.
//
// In: all stages before. Out: the public CutMesh (see mandoline.h for its arrays and their order).
#pragma once

#include "cut/stages/regions.h"

namespace mandoline::detail {

CutMesh makeOutput(const MeshView& mesh, const Grid& grid, const Input& input, const Stencil& stencil, TriFaces&& triFaces,
                   GridFaces&& gridFaces, CutCells&& cells, Regions&& regions, const CutVertices& vertices, CutStats& stats,
                   Monitor& monitor);

}  // namespace mandoline::detail
