// Made vertices that rounding put onto another one, moved apart. Part of output_part.h.
//
// In: the vertices of a result. Out: no two of them have the same position.
#pragma once

#include "base/parallel.h"
#include "cut/stages/kept_vertices.h"

namespace mandoline::detail {

/// Moves made vertices by a few units in the last place, in ascending order; kept vertices have been moved before.
void separate(const KeptVertices& kept, bool doTrianglesMeet, CutMesh& out, Monitor& monitor);

}  // namespace mandoline::detail
