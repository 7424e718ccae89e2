// Bricks of the cut before in which nothing has moved: they are kept as they were cut then, with new ids of the surface's vertices.
//
// In: the cut before, of triangles with the same ids and of the same bricks, and the whole SurfaceMap; the Surface, SurfaceParts and Bricks
// now; ChangedBricks, where they are known. Out: KeptBricks, and the grid cells that these touch, marked in Bricks. A brick is kept if its
// triangles, what others leave on them, and the vertices and edges on its seams are where they were: then all that it is cut of is the same
// to the bit.
#pragma once

#include "cut/stages/brick_cut.h"
#include "cut/stages/changed_bricks.h"

namespace mandoline::detail {

/// The cut before, whose bricks are moved out of it.
struct CutBefore {
  const Surface& surface;
  const SurfaceParts& parts;
  const Bricks& bricks;
  BrickCuts& cuts;
};

/// What is now, with the bricks that have changed; null if that has to be found.
struct CutNow {
  const Surface& surface;
  const SurfaceParts& parts;
  Bricks& bricks;
  const ChangedBricks* changed;
};

KeptBricks keepBricks(const CutBefore& before, SurfaceMap map, const CutNow& now);

}  // namespace mandoline::detail
