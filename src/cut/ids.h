// Ids of cut-faces and half-faces, which must not be mixed up. The cut-mesh holds their bare numbers.
#pragma once

#include <cstdint>

namespace mandoline::detail {

/// A cut-face: tri-cut-faces come first, then pieces of grid-faces.
struct FaceId {
  uint32_t number;
};

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

}  // namespace mandoline::detail
