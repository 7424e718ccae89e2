// Triangles that meet (paper, Appendix A): divides the tri-cut-faces of triangles whose inside has vertices and edges of others, so that
// faces meet in shared vertices and edges alone.
//
// In: Surface, and the whole tri-cut-faces of such triangles. Out: their faces at the end of TriFaces, with holes, and with edges that end
// inside of them in their loops, in both directions. Where triangles lie on each other, the lowest has the face and the others are its
// other parents. After it: hybrid edges are cut at all vertices on them, and none lies on a tri-edge or in a face that was left out.
#pragma once

#include "cut/stages/tri_faces.h"

namespace mandoline::detail {

void divideFaces(const Surface& surface, const UndividedFaces& undivided, TriFaces& faces, Run& run);

}  // namespace mandoline::detail
