// What vertices that half-faces share tell about the nesting inside of one grid cell, without a ray. Part of cut_cells.h.
#pragma once

#include "cut/stages/cell_view.h"

namespace mandoline::detail {

/// Unites all half-faces about each vertex whose faces enclose no directions: seen from the vertex, they are arcs from edge to edge, and if
/// no arcs form a ring, one can look past them from everywhere to everywhere.
void uniteAtVertices(const CellView& cell, Shells& shells);

}  // namespace mandoline::detail
