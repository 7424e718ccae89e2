// Nesting inside of one grid cell (the paper leaves it to its users, section 6): components of the surface that touch no grid-face by an
// edge, and the shell of half-faces that each shows to the outside.
//
// Such a component is made of whole triangles. Its outer side is a cavity (or floating sheet) of the cut-cell around it.
#pragma once

#include <algorithm>
#include <vector>

#include "base/disjoint_sets.h"
#include "cut/stages/cut_faces.h"

namespace mandoline::detail {

/// The half-faces of one grid cell: those of its tri-cut-faces, two each, then those of its six grid-faces.
struct CellHalves {
  uint32_t stencilCell;
  std::span<const uint32_t> triFaces;  ///< ids; local half-faces 2 i and 2 i + 1 are the sides of triFaces[i]
  std::vector<HalfFace> halfFaces;     ///< per local half-face

  size_t triHalves() const { return 2 * triFaces.size(); }
  /// The local half-face of a half-face of a grid-face.
  uint32_t localOf(HalfFace halfFace) const {
    return uint32_t(std::find(halfFaces.begin() + std::ptrdiff_t(triHalves()), halfFaces.end(), halfFace) - halfFaces.begin());
  }
};

/// A grid cell and what its half-faces are made of.
struct CellView {
  const Surface& surface;
  const Stencil& stencil;
  const CutFaces& faces;
  const CellHalves& halves;
};

/// Unites the outer shell of each floating component with the shell of the cut-cell that holds it.
void nestFloatingShells(const CellView& cell, DisjointSets& shells, Predicates& predicates);

}  // namespace mandoline::detail
