// Bricks of a surface of which most is where it was: what belongs to them is known of those alone that have to be cut again.
//
// In: ChangedBricks, and all SurfaceParts of the triangles in them; the bricks before. Out: Bricks, the same as of layOutBricks(), but only
// changed ones have parts, edges and vertices on seams, and all their triangles.
#pragma once

#include "cut/stages/changed_bricks.h"

namespace mandoline::detail {

/// Moves triangles of bricks out of `before`.
Bricks layOutAgain(const Surface& surface, const SurfaceParts& parts, const ChangedBricks& changed, Bricks& before);

}  // namespace mandoline::detail
