// What the stages number. Kinds don't mix; the cut-mesh holds bare numbers.
#pragma once

#include <algorithm>

#include "mesh/ids.h"

namespace mandoline::detail {

using FaceId = Id<struct CutFaceTag>;  ///< tri-cut-faces come first, then pieces of grid-faces
using CellId = Id<struct CellTag>;

using GridCellId = Id<struct GridCellTag>;  ///< grid cells, grid-faces, grid-edges and grid vertices of the stencil
using GridFaceId = Id<struct GridFaceTag>;
using GridEdgeId = Id<struct GridEdgeTag>;
using GridVertexId = Id<struct GridVertexTag>;

/// One side of a cut-face. Side 0: the face's normal points out of the cell, side 1: into it.
struct HalfFace {
  uint32_t number;  ///< 2 * face + side

  HalfFace() = default;
  explicit HalfFace(uint32_t number_) : number(number_) {}
  HalfFace(FaceId face, uint32_t side) : number(2 * face.number + side) {}

  FaceId face() const { return {number / 2}; }
  uint32_t side() const { return number & 1; }
  HalfFace twin() const { return HalfFace(number ^ 1); }
  bool operator==(const HalfFace&) const = default;
};

/// Of an edge, whichever way it runs.
inline uint64_t keyOf(VertexId u, VertexId v) { return uint64_t(std::min(u, v).number) << 32 | std::max(u, v).number; }

}  // namespace mandoline::detail
