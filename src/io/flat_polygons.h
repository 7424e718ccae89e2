// Polygons that have no area, since they are no wider than what rounding makes of coordinates: OpenFOAM divides by areas and heights.
#pragma once

#include <array>
#include <map>

#include "base/shared.h"
#include "io/complex_polygons.h"
#include "io/polygon_sharing.h"

namespace mandoline::detail {

/// Takes them away. The edges of a flat polygon that lie on others get its vertices, in all polygons that have them, and vertices that are
/// one but for rounding become one; then what is left of its boundary cancels. So the polygons of a cell fit together as before, and move
/// by rounding alone. A face may then have several polygons, or none.
MANDOLINE_SHARED void collapseFlatPolygons(const CellComplex& cells, ComplexPolygons& polygons, PolygonSharing& sharing);

/// Where vertices are written instead of where they are, if not there.
using MovedVertices = std::map<uint32_t, std::array<double, 3>>;

/// Moves walls that lie in a plane with the centroid of a cell beside them, but for rounding, as those of a flat sheet do that ends in the
/// middle of a cell: OpenFOAM divides by how far they are from it. They move by more than rounding, and by 2^-44 of the largest coordinate.
MANDOLINE_SHARED MovedVertices movedOffCentroids(const CellComplex& cells, const ComplexPolygons& polygons, PolygonSharing& sharing);

/// Whether a cell has no faces but walls, so that nothing flows into it.
MANDOLINE_SHARED bool isEnclosedByWalls(const CellComplex& cells, const ComplexPolygons& polygons, size_t cell);

}  // namespace mandoline::detail
