// The stencil (paper, 4.3.1): the grid cells that the surface touches, their grid-faces, grid-edges and grid vertices, and the parts of
// the surface in each.
//
// In: BrickSurface. Out: its part of the stencil. A grid cell belongs to it if a tri-cut-face lies inside of it or in one of its
// grid-faces, or a tri-edge in one of its grid-faces: so every grid-face between it and an untouched grid cell is whole.
#pragma once

#include <vector>

#include "cut/stages/brick_surface.h"

namespace mandoline::detail {

/// Numbering inside of a cell, by bits: 1 for the upper side along an axis.
/// Corner: bit d for axis d. Grid-face: 2 * axis + side. Grid-edge along d: 4 * d + side along d + 1, + 2 * side along d + 2 (mod 3).
constexpr int cellFace(int axis, int side) { return 2 * axis + side; }
constexpr int cellEdge(int axis, int side1, int side2) { return 4 * axis + side1 + 2 * side2; }

struct Stencil {
  struct Cell {
    Slab element;  ///< all odd
    std::array<GridFaceId, 6> faces;
    std::array<GridEdgeId, 12> edges;
    std::array<GridVertexId, 8> corners;

    int32_t at(int axis) const { return element[axis] >> 1; }
  };
  /// A grid-face, by the first cell that has it.
  struct Face {
    GridCellId cell;
    uint8_t index;  ///< in that cell

    int axis() const { return index >> 1; }
    int side() const { return index & 1; }
  };

  BrickBox box;
  IdVector<GridCellId, Cell> cells;  ///< ascending by z, then y, then x
  IdVector<GridFaceId, Face> faces;
  uint32_t edgeCount = 0, cornerCount = 0;
  Csr<FaceId, GridCellId> triFacesInCell;  ///< tri-cut-faces inside of each cell
  Csr<FaceId, GridFaceId> triFacesOnFace;  ///< tri-cut-faces that lie in each grid-face
  Csr<FaceEdge, GridFaceId> edgesOnFace;   ///< cut-edges inside of each grid-face

  /// The corners of a grid-face, counter-clockwise about its axis, and the grid-edge from each to the next. Edges 2 and 3 run against their
  /// axis.
  std::array<GridVertexId, 4> cornersOf(const Face& face) const;
  std::array<GridEdgeId, 4> edgesOf(const Face& face) const;
  /// A grid cell of the brick, if it belongs to the stencil.
  std::optional<GridCellId> find(const Slab& cell) const;
  /// A cell that has a grid element, and lies in the brick.
  std::optional<GridCellId> cellBeside(const Slab& element) const;

  /// Numbers of cells in the brick with a margin of one cell; kNone for those that are not touched.
  std::vector<uint32_t> table;
  static constexpr uint32_t kNone = ~0u;

  size_t placeOf(const Slab& cell) const {
    const auto at = [&](size_t d) { return size_t((cell[d] >> 1) - box.first[d] + 1); };
    return (at(2) * size_t(box.count[1] + 2) + at(1)) * size_t(box.count[0] + 2) + at(0);
  }
};

/// Replaces `stencil`, whose memory is used again.
void makeStencil(const BrickSurface& surface, const Bricks& bricks, BrickId brick, Stencil& stencil);

}  // namespace mandoline::detail
