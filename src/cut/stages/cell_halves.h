// The half-faces of one grid cell, numbered on their own while it is made into cut-cells (cut_cells.h).
#pragma once

#include <algorithm>

#include "base/disjoint_sets.h"
#include "cut/stages/cut_faces.h"

namespace mandoline::detail {

using LocalFace = Id<struct LocalFaceTag>;  ///< a tri-cut-face of the cell
using LocalHalf = Id<struct LocalHalfTag>;  ///< a half-face: those of tri-cut-faces first, two each, then those of the six grid-faces

/// One side of a tri-cut-face, as of HalfFace.
inline LocalHalf sideOf(LocalFace face, uint32_t side) { return {2 * face.number + side}; }

/// Half-faces that bound the same cut-cell: joined by edges, later by vertices and nesting, too.
using Shells = IdSets<LocalHalf>;

struct CellHalves {
  GridCellId gridCell;
  std::span<const FaceId> triFaces;  ///< per LocalFace
  IdVector<LocalHalf, HalfFace> halfFaces;

  FaceId triFace(LocalFace face) const { return triFaces[face.number]; }
  Ids<LocalFace> localFaces() const { return Ids<LocalFace>(triFaces.size()); }
  /// The half-faces of tri-cut-faces, and those of grid-faces.
  Ids<LocalHalf> triHalves() const { return Ids<LocalHalf>(firstOfGrid()); }
  Ids<LocalHalf> gridHalves() const { return {firstOfGrid(), halfFaces.size()}; }
  /// The local half-face of a half-face of a grid-face.
  LocalHalf localOf(HalfFace halfFace) const {
    return {uint32_t(std::find(halfFaces.begin() + std::ptrdiff_t(firstOfGrid()), halfFaces.end(), halfFace) - halfFaces.begin())};
  }

 private:
  size_t firstOfGrid() const { return 2 * triFaces.size(); }
};

}  // namespace mandoline::detail
