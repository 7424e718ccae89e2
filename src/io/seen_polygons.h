// Polygons whose centre does not see all of their edges: OpenFOAM makes tetrahedra of these, and sums them to centres and volumes.
#pragma once

#include "base/shared.h"
#include "io/complex_polygons.h"

namespace mandoline::detail {

/// Divides those of faces of the grid along diagonals, and those in which no vertex sees all edges either, into pieces without such faults;
/// where some piece would have one, as between vertices that are nearly on a line, the polygon stays. Both cells of a face have the same
/// pieces, so they fit together as before. Walls stay: pieces of triangles are convex.
MANDOLINE_SHARED void dividePolygonsNotSeen(const CellComplex& cells, ComplexPolygons& polygons);

}  // namespace mandoline::detail
