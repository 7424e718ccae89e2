// Bricks of the cut before in which nothing has moved: they are kept as they were cut then, with new ids of the surface's vertices.
//
// In: the cut before, of triangles with the same ids and of the same bricks, and the whole SurfaceMap; the Surface, SurfaceParts and Bricks
// now. Out: KeptBricks, and the grid cells that these touch, marked in Bricks. A brick is kept if its triangles, what others leave on them,
// and the vertices and edges on its seams are where they were: then all that it is cut of is the same to the bit.
#pragma once

#include "cut/stages/brick_cut.h"
#include "cut/stages/surface_map.h"

namespace mandoline::detail {

/// The cut before, whose bricks are moved out of it.
struct CutBefore {
  const Surface& surface;
  const SurfaceParts& parts;
  const Bricks& bricks;
  BrickCuts& cuts;
};

KeptBricks keepBricks(const CutBefore& before, SurfaceMap now, const Surface& surface, const SurfaceParts& parts, Bricks& bricks);

}  // namespace mandoline::detail
