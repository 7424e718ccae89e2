// Which triangles each brick of a grid needs, for bricks that are cut by themselves, with a margin of one grid cell: a cell of the brick
// may have a vertex, on a grid line, of triangles that touch none but its neighbours around that line.
#pragma once

#include <span>

#include "cut/stages/brick_grid.h"
#include "cut/stages/polygon.h"

namespace mandoline::detail {

/// Items by keys, of which most have none.
struct KeyedTriangles {
  std::vector<uint64_t> keys;  ///< those that have any, ascending
  Csr<uint32_t> triangles;     ///< per key, ascending

  std::span<const uint32_t> operator[](uint64_t key) const;
};

/// A brick and the cells around it, as far as the grid goes.
BrickBox withMargin(const BrickGrid& bricks, uint64_t key);

struct BrickTriangles {
  KeyedTriangles near;   ///< by bricks: kept triangles whose boxes meet the closed brick with its margin
  KeyedTriangles below;  ///< by rows of bricks along x: those that the line along the lowest corners of their margins may cross
};

BrickTriangles findBrickTriangles(const Input& input, const BrickGrid& bricks);

/// What winds around the lowest corner of a brick's margin, as Input::cornerWinding.
std::vector<int32_t> windingAtBrick(const Input& input, const BrickGrid& bricks, const BrickTriangles& triangles, uint64_t key);

}  // namespace mandoline::detail
