// Bricks: boxes of grid cells, each of which is cut on its own.
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
// Ownership: every cut-cell lies in one brick. A grid-face, grid-edge or grid vertex, and with it what is cut there, belongs to the first
// touched grid cell that has it (by z, then y, then x), so s to A. Numbers of the result follow these cells: so they depend on the mesh and
// the grid alone, on no size of bricks, nor on the order in which they are cut.
#pragma once

#include <algorithm>

#include "base/id.h"
#include "cut/scaled_input.h"

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

/// How the grid is divided into bricks. Each has a key: its place by z, y, x.
struct BrickGrid {
  /// Bricks of 32 cells along each side fit into a processor's cache. Smaller ones of a small grid give each thread several.
  static int shiftFor(const Input& input, unsigned threads) {
    constexpr int kUsual = 5, kLeast = 3;
    constexpr size_t kEach = 16;
    const auto count = [&](int shift) {
      size_t bricks = 1;
      for (int d = 0; d < 3; ++d) bricks *= size_t((input.cells(d) - 1) >> shift) + 1;
      return bricks;
    };
    int shift = kUsual;
    while (threads > 1 && shift > kLeast && count(shift) < kEach * threads) --shift;
    return shift;
  }

  int shift = 0;                             ///< 2^shift grid cells along each side of a brick, or what is left of the grid
  std::array<int32_t, 3> cells{}, counts{};  ///< of grid cells and bricks along each axis

  BrickGrid() = default;
  BrickGrid(const Input& input, int shift_) : shift(shift_) {
    for (size_t d = 0; d < 3; ++d) {
      cells[d] = input.cells(int(d));
      counts[d] = ((cells[d] - 1) >> shift) + 1;
    }
  }

  /// Of the brick that has a cell of the grid.
  uint64_t keyOf(const Slab& cell) const {
    const auto at = [&](size_t d) { return uint64_t(cell[d] >> 1 >> shift); };
    return (at(2) * uint64_t(counts[1]) + at(1)) * uint64_t(counts[0]) + at(0);
  }
  BrickBox boxOf(uint64_t key) const {
    const uint64_t row = key / uint64_t(counts[0]);
    const std::array<uint64_t, 3> at = {key % uint64_t(counts[0]), row % uint64_t(counts[1]), row / uint64_t(counts[1])};
    BrickBox box;
    for (size_t d = 0; d < 3; ++d) {
      box.first[d] = int32_t(at[d]) << shift;
      box.count[d] = std::min(int32_t(1) << shift, cells[d] - box.first[d]);
    }
    return box;
  }
  bool hasCell(const Slab& cell) const {
    bool inside = true;
    for (size_t d = 0; d < 3; ++d) inside &= uint32_t(cell[d] >> 1) < uint32_t(cells[d]);
    return inside;
  }
  /// Calls f(cell) for the cells of the grid that have a grid element, one of each brick.
  template <class F>
  void forBricks(const Slab& element, const F& f) const {
    findCellAround(element, [&](const Slab& cell) {
      bool isNew = hasCell(cell);
      for (size_t d = 0; d < 3; ++d) isNew &= cell[d] <= element[d] || (cell[d] >> 1 & ((1 << shift) - 1)) == 0;
      if (isNew) f(cell);
      return false;
    });
  }
  /// Whether an element lies on a plane between bricks.
  bool isOnSeam(const Slab& element) const {
    const int32_t others = (2 << shift) - 1;
    bool isOn = false;
    for (size_t d = 0; d < 3; ++d) isOn |= (element[d] & others) == 0 && element[d] > 0 && element[d] < 2 * cells[d];
    return isOn;
  }
  /// Whether some of it may lie there: a slab beside such a plane.
  bool isBesideSeam(const Slab& element) const {
    const int32_t others = (2 << shift) - 1;
    bool isBeside = false;
    for (const int32_t slab : element) isBeside |= ((slab + 1) & others) <= 2;
    return isBeside;
  }
};

}  // namespace mandoline::detail
