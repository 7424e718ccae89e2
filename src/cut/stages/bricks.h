// Bricks that the surface touches, each with the parts of the surface in its closed box: see brick_grid.h.
//
// In: Surface. Out: SurfaceParts, Bricks, all of them to be cut here. Which grid cells are touched is marked by each brick when it is cut.
#pragma once

#include <bit>
#include <optional>
#include <span>

#include "cut/stages/clipped_triangles.h"

namespace mandoline::detail {

/// What bricks are given parts of.
struct SurfaceParts {
  ClippedTriangles clipped;
  TriFaces divided;  ///< faces of triangles whose inside others reach into
};

/// A cut-edge in a grid-face: those that clipping made come first, then those of divided triangles, then those of tri-edges.
const FaceEdge& faceEdge(const Surface& surface, const SurfaceParts& parts, uint32_t i);

/// The bricks that this process cuts: all, or one of several shares of a cut (see mandoline/cut_share.h), which are layers of them.
struct BricksHere {
  BrickId first{0}, past{0};
  bool isShare = false;  ///< whether other processes cut, too

  Ids<BrickId> ids() const { return {first, past}; }
  /// Their numbers, for runItems() on so many threads: far from each other, since bricks side by side write to the same cache lines.
  std::vector<uint32_t> numbers(unsigned threads = 1) const;
  size_t size() const { return past.number - first.number; }
  bool has(BrickId brick) const { return brick >= first && brick < past; }
};

struct Bricks {
  BrickGrid grid;
  BricksHere here;
  IdVector<BrickId, uint64_t> keys;  ///< ascending
  std::vector<uint32_t> rows;  ///< per row of bricks along x, up to the last one with any: which of them comes first in it or after it
  IdVector<BrickId, BrickBox> boxes;
  IdVector<BrickId, size_t> firstBit;  ///< in `touched`
  std::vector<uint64_t> touched;       ///< a bit for each cell of each brick: whether it belongs to the stencil
  // Of each brick, ascending:
  Csr<uint32_t, BrickId> parts;         ///< clipped.parts
  Csr<FaceId, BrickId> dividedFaces;    ///< those in its cells, or in grid-faces of these
  Csr<uint32_t, BrickId> faceEdges;     ///< those in grid-faces of its cells, as of faceEdge()
  Csr<VertexId, BrickId> seamVertices;  ///< of the surface, on those grid lines of its boundary that other bricks have, too

  size_t size() const { return keys.size(); }
  Ids<BrickId> ids() const { return keys.ids(); }
  /// Appends one, of which no cell is touched so far.
  BrickId add(uint64_t key);
  /// The brick that has a cell of the grid.
  std::optional<BrickId> find(const Slab& cell) const;
  /// The brick that has a cell of the grid, if the cell belongs to the stencil.
  std::optional<BrickId> findTouched(const Slab& cell) const;
  bool isTouched(const Slab& cell) const { return findTouched(cell).has_value(); }
  bool isTouched(BrickId brick, uint32_t index) const {
    const size_t bit = firstBit[brick] + index;
    return touched[bit / 64] >> bit % 64 & 1;
  }
  /// The words of `touched` that a brick has: others have none of them.
  std::span<const uint64_t> wordsOf(BrickId brick) const { return std::span(touched).subspan(firstBit[brick] / 64, wordCount(brick)); }
  std::span<uint64_t> wordsOf(BrickId brick) { return std::span(touched).subspan(firstBit[brick] / 64, wordCount(brick)); }
  size_t wordCount(BrickId brick) const { return (boxes[brick].size() + 63) / 64; }
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

/// The axis that a grid-face lies across.
inline int planeAxis(const Slab& gridFace) { return int(onPlane(gridFace[1])) + 2 * int(onPlane(gridFace[2])); }

Bricks layOutBricks(const Surface& surface, const SurfaceParts& parts, const BrickGrid& grid, Monitor& monitor);

}  // namespace mandoline::detail
