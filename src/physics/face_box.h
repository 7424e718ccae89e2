// Faces of octree cells as rectangles along the axes.
#pragma once

#include <algorithm>

#include "physics/fit_data.h"

namespace mandoline::physics {

struct FaceBox {
  Point low, high;
};

inline FaceBox faceBox(const CellComplex& cells, size_t face) {
  FaceBox box{pointAt(cells.faceCentroid, face), pointAt(cells.faceCentroid, face)};
  for (const uint32_t v : cells.loops(face)[0]) {
    const Point at = pointAt(cells.positions, v);
    for (size_t d = 0; d < 3; ++d) box.low[d] = std::min(box.low[d], at[d]), box.high[d] = std::max(box.high[d], at[d]);
  }
  return box;
}

/// How much more than at its centroid a function is in the mean on a rectangle, per second derivative along each axis.
inline Point spreadOf(const CellComplex& cells, size_t face) {
  const FaceBox box = faceBox(cells, face);
  Point spread;
  for (size_t d = 0; d < 3; ++d) spread[d] = (box.high[d] - box.low[d]) * (box.high[d] - box.low[d]) / 24;
  return spread;
}

}  // namespace mandoline::physics
