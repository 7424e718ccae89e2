// Bricks: boxes of grid cells, which the stages from the stencil to the cut-cells take one by one, each on its own.
//
// In: Surface, TriFaces. Out: Bricks, those that the surface touches, each with the parts of the surface in its closed box.
//
// Seen along z, bricks of 4 x 4 grid cells. The surface touches those marked x:
//
//        brick A     |     brick B
//     .   .   .   .  |  .   .   .   .
//     .   .   x   x  s  x   x   .   .        s: a grid-face on the seam. A and B both cut it, since their cells have
//     x   x   x   .  |  .   x   x   .        its pieces, and get the same: the same lies in it, in the same order,
//     .   .   .   .  |  .   .   .   x        and all decisions are exact.
//    ----------------+-----------------
//        brick C     |     brick D
//
// Ownership: every cut-cell lies in one brick. A grid-face or grid vertex, and with it what is cut there, belongs to the first touched grid
// cell that has it (by z, then y, then x), so s to A. Which cells are touched is known before any brick is cut. So the numbers of the
// result, which follow these cells, depend on the mesh and the grid alone: on no size of bricks, nor on the order in which they are cut.
#pragma once

#include <bit>
#include <optional>
#include <span>

#include "cut/stages/tri_faces.h"

namespace mandoline::detail {

using BrickId = Id<struct BrickTag>;

/// The grid cells of a brick.
struct BrickBox {
  std::array<int32_t, 3> first, count;  ///< along each axis

  bool has(const Slab& cell) const {
    bool inside = true;
    for (size_t d = 0; d < 3; ++d) inside &= uint32_t((cell[d] >> 1) - first[d]) < uint32_t(count[d]);
    return inside;
  }
  /// Of a cell that it has: x fastest.
  uint32_t indexOf(const Slab& cell) const {
    const auto at = [&](size_t d) { return uint32_t((cell[d] >> 1) - first[d]); };
    return (at(2) * uint32_t(count[1]) + at(1)) * uint32_t(count[0]) + at(0);
  }
  Slab cellAt(uint32_t index) const {
    const int32_t row = int32_t(index) / count[0], x = int32_t(index) % count[0];
    return {2 * (first[0] + x) + 1, 2 * (first[1] + row % count[1]) + 1, 2 * (first[2] + row / count[1]) + 1};
  }
  uint32_t size() const { return uint32_t(count[0]) * uint32_t(count[1]) * uint32_t(count[2]); }
};

struct Bricks {
  int shift;                         ///< 2^shift grid cells along each side of a brick, or what is left of the grid
  std::array<int32_t, 3> counts;     ///< of bricks along each axis
  IdVector<BrickId, uint64_t> keys;  ///< places by z, y, x: ascending
  IdVector<BrickId, BrickBox> boxes;
  IdVector<BrickId, size_t> firstBit;       ///< in `touched`
  std::vector<uint64_t> touched;            ///< a bit for each cell of each brick: whether it belongs to the stencil
  Csr<FaceId, BrickId> triFaces;            ///< those in the cells of a brick, or in grid-faces of these: ascending in each
  Csr<uint32_t, BrickId> faceEdges;         ///< those in grid-faces of its cells, as of faceEdge(): ascending in each
  Csr<VertexId, BrickId> seamVertices;      ///< of the surface, on those grid lines of its boundary that other bricks have, too
  IdVector<BrickId, VertexId> firstOnGrid;  ///< where the grid vertices of a brick begin; those on seams occur once for each brick

  size_t size() const { return keys.size(); }
  Ids<BrickId> ids() const { return keys.ids(); }
  /// That of the brick that has a cell of the grid.
  uint64_t keyOf(const Slab& cell) const {
    const auto at = [&](size_t d) { return uint64_t(cell[d] >> 1 >> shift); };
    return (at(2) * uint64_t(counts[1]) + at(1)) * uint64_t(counts[0]) + at(0);
  }
  /// The brick that has a cell of the grid, if the cell belongs to the stencil.
  std::optional<BrickId> findTouched(const Slab& cell) const;
  bool isTouched(const Slab& cell) const { return findTouched(cell).has_value(); }
  bool isTouched(BrickId brick, uint32_t index) const {
    const size_t bit = firstBit[brick] + index;
    return touched[bit / 64] >> bit % 64 & 1;
  }
  /// Bits for the cells from one on, up to 64 of them: whether they are touched.
  uint64_t touchedFrom(BrickId brick, uint32_t index, uint32_t count) const {
    const size_t bit = firstBit[brick] + index;
    uint64_t bits = touched[bit / 64] >> bit % 64;
    if (bit % 64 + count > 64) bits |= touched[bit / 64 + 1] << (64 - bit % 64);
    return count < 64 ? bits & ((uint64_t(1) << count) - 1) : bits;
  }
  /// Calls f(index) for the touched cells of a brick, ascending.
  template <class F>
  void forTouched(BrickId brick, const F& f) const {
    for (uint32_t begin = 0; begin < boxes[brick].size(); begin += 64) {
      for (uint64_t word = touched[(firstBit[brick] + begin) / 64]; word != 0; word &= word - 1)
        f(begin + uint32_t(std::countr_zero(word)));
    }
  }
};

/// A cut-edge in a grid-face: those of triangles come first, then those of tri-edges.
inline const FaceEdge& faceEdge(const Surface& surface, const TriFaces& faces, uint32_t i) {
  return i < faces.hybridEdges.size() ? faces.hybridEdges[i] : surface.edgesInPlane[i - faces.hybridEdges.size()];
}

/// The axis that a grid-face lies across.
inline int planeAxis(const Slab& gridFace) { return onPlane(gridFace[0]) ? 0 : onPlane(gridFace[1]) ? 1 : 2; }

/// Makes room in `surface.vertices` for the grid vertices of all bricks.
Bricks layOutBricks(Surface& surface, const TriFaces& faces, const Run& run);

}  // namespace mandoline::detail
