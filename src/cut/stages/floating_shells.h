// Nesting inside of one grid cell (the paper leaves it to its users, section 6): components of the surface that touch no grid-face by an
// edge, and the shell of half-faces that each shows to the outside.
//
// Such a component is made of whole triangles. Its outer side is a cavity (or floating sheet) of the cut-cell around it.
#pragma once

#include <vector>

#include "base/disjoint_sets.h"
#include "cut/stages/grid_faces.h"

namespace mandoline::detail {

/// The half-faces of one grid cell: those of its tri-cut-faces, two each, then those of its six grid-faces.
struct CellHalves {
  uint32_t stencilCell;
  std::span<const uint32_t> triFaces;  ///< ids; local half-faces 2 i and 2 i + 1 are the sides of triFaces[i]
  std::vector<uint32_t> halfFaces;     ///< per local half-face

  size_t triHalves() const { return 2 * triFaces.size(); }
};

/// Unites the outer shell of each floating component with the shell of the cut-cell that holds it.
void nestFloatingShells(const Input& input, const Stencil& stencil, const TriFaces& triFaces, const GridFaces& gridFaces,
                        const CutVertices& vertices, const CellHalves& cell, DisjointSets& shells, Predicates& predicates);

}  // namespace mandoline::detail
