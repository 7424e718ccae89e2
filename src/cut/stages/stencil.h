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

/// The corners of a grid-face of a cell, counter-clockwise about its axis, and the grid-edge from each to the next. Edges 2 and 3 run
/// against their axis.
struct Outline {
  std::array<uint8_t, 4> corners, edges;
};
constexpr Outline cellOutline(int axis, int side) {
  const int base = side << axis, p = (axis + 1) % 3, q = (axis + 2) % 3;
  const auto corner = [&](int atP, int atQ) { return uint8_t(base + (atP << p) + (atQ << q)); };
  return {{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)},
          {uint8_t(cellEdge(p, 0, side)), uint8_t(cellEdge(q, side, 1)), uint8_t(cellEdge(p, 1, side)), uint8_t(cellEdge(q, side, 0))}};
}
inline constexpr std::array<Outline, 6> kOutlines = {cellOutline(0, 0), cellOutline(0, 1), cellOutline(1, 0),
                                                     cellOutline(1, 1), cellOutline(2, 0), cellOutline(2, 1)};

/// A cut-edge inside of a grid-face.
struct EdgeOnFace {
  VertexId from, to;
};

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
  Csr<FaceId, GridCellId> triFacesInCell;   ///< tri-cut-faces inside of each cell
  Csr<FaceId, GridFaceId> triFacesOnFace;   ///< tri-cut-faces that lie in each grid-face
  Csr<EdgeOnFace, GridFaceId> edgesOnFace;  ///< cut-edges inside of each grid-face

  /// A grid cell of the brick, if it belongs to the stencil.
  std::optional<GridCellId> find(const Slab& cell) const;

  /// Numbers of cells in the brick with a margin of one cell; kNone for those that are not touched.
  std::vector<uint32_t> table;
  static constexpr uint32_t kNone = ~0u;
  // In the table, all modulo its type, which is too small for some grids as a whole:
  std::array<size_t, 3> steps{};  ///< to the next cell along each axis
  size_t placeOfFirst = 0;        ///< of the grid's first cell, were it there

  /// Of a cell; of another element that of the cell above the planes it lies on.
  size_t placeOf(const Slab& element) const {
    const auto at = [&](size_t d) { return size_t(ptrdiff_t(element[d] >> 1)); };
    return at(0) + at(1) * steps[1] + at(2) * steps[2] + placeOfFirst;
  }
  uint32_t numberAt(size_t place) const { return table[place]; }

  // Scratch.
  std::vector<GridCellId> cellOf;  ///< per tri-cut-face
  std::vector<GridFaceId> faceOf;  ///< per cut-edge in a grid-face
};

/// Groups those items that have a place: placeOf[i] of the i-th, or Stencil::kNone. Replaces `csr`, whose memory is used again.
template <class Item, class Place, class ItemOf>
void groupByPlace(size_t places, const std::vector<Place>& placeOf, const ItemOf& itemOf, Csr<Item, Place>& csr) {
  constexpr Place kNone{Stencil::kNone};
  csr.offsets.assign(places + 1, 0);
  for (const Place place : placeOf) {
    if (place != kNone) ++csr.offsets[place.number];
  }
  csr.items.resize(toOffsets(csr.offsets));
  for (uint32_t i = 0; i < placeOf.size(); ++i) {
    if (placeOf[i] != kNone) csr.items[csr.offsets[placeOf[i].number]++] = itemOf(i);
  }
  moveBack(csr.offsets);
}

/// Replaces `stencil`, whose memory is used again.
void makeStencil(const BrickSurface& surface, const Bricks& bricks, BrickId brick, Stencil& stencil);

}  // namespace mandoline::detail
