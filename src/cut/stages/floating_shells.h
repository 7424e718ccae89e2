// Nesting inside of one grid cell (the paper leaves it to its users, section 6): components of the surface that touch no grid-face by an
// edge, and the shell of half-faces that each shows to the outside.
//
// Such a component is made of whole triangles. Its outer side is a cavity (or floating sheet) of the cut-cell around it. Components that
// share a vertex are one where that alone tells (see shared_vertices.h); for the others a ray finds the next thing behind each.
#pragma once

#include "cut/stages/cell_view.h"

namespace mandoline::detail {

/// Unites the outer shell of each floating component with the shell of the cut-cell that holds it.
void nestFloatingShells(const CellView& cell, Shells& shells, Predicates& predicates);

}  // namespace mandoline::detail
