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
//
// Where several processes cut, each has a share: layers of grid cells. Seen along y, with bricks of up to 4 layers:
//
//     z  17 +---------+---------+
//           |    G    |    H    |   what is left of the grid            share 2
//        16 +---------+---------+
//           |    E    |    F    |
//        12 +=========+=========+   where shares meet: a seam as others are
//           |    C    |    D    |   what is left of the share           share 1
//        10 +---------+---------+
//           |    A    |    B    |   bricks begin anew with the share
//         6 +=========+=========+
//           |         |         |                                       share 0
//
// So a brick lies in one share, shares meet in any plane across z, and all processes know all bricks by the same keys.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

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

/// Layers of grid cells along z, from the first up to, not including, the second.
struct CellLayers {
  int32_t first = 0, past = 0;
};

/// How the grid is divided into bricks. Each has a key: its place by z, y, x.
class BrickGrid {
 public:
  /// Bricks of 32 cells along each side fit into a processor's cache. Of a small grid each thread has several, smaller along z first: what
  /// lies in a seam is cut on both sides.
  static std::array<int, 3> shiftsFor(const Input& input, unsigned threads) {
    constexpr int kUsual = 5, kLeast = 3;
    constexpr size_t kEach = 8;
    std::array<int, 3> shifts = same(kUsual);
    const auto areFew = [&] { return threads > 1 && countFor(input, shifts) < kEach * threads; };
    for (size_t d = 2; areFew() && shifts[0] > kLeast; d = (d + 2) % 3) --shifts[d];
    return shifts;
  }
  static std::array<int, 3> same(int shift) { return {shift, shift, shift}; }
  /// Those of a surface that moves are smaller, so that little is cut again, and long along x, so that rows have few parts.
  static std::array<int, 3> shiftsForMoving(const Input& input) {
    constexpr int kLeast = 1;
    constexpr size_t kSeveral = 64;
    std::array<int, 3> shifts{5, 3, 3};
    while (countFor(input, shifts) < kSeveral && shifts[0] > kLeast) {
      const int less = shifts[0] - 1;
      shifts = {less, std::min(less, shifts[1]), std::min(less, shifts[2])};
    }
    return shifts;
  }

  std::array<int, 3> shifts{};               ///< 2^shift grid cells along each side of a brick, or what is left of the grid
  std::array<int32_t, 3> cells{}, counts{};  ///< of grid cells and bricks along each axis
  CellLayers here;                           ///< that are cut: all, or those of one of several processes

  BrickGrid() = default;
  /// `anew`: layers of grid cells, ascending, with which bricks begin anew along z.
  BrickGrid(const Input& input, const std::array<int, 3>& shifts_, std::span<const int32_t> anew = {}) : shifts(shifts_) {
    for (size_t d = 0; d < 3; ++d) {
      cells[d] = input.cells(int(d));
      counts[d] = ((cells[d] - 1) >> shifts[d]) + 1;
    }
    here.past = cells[2];
    for (int32_t layer = 0; layer < cells[2];) {
      layers_.push_back(layer);
      const auto next = std::upper_bound(anew.begin(), anew.end(), layer);
      layer += std::min(int32_t(1) << shifts[2], (next == anew.end() ? cells[2] : *next) - layer);
    }
    counts[2] = int32_t(layers_.size());
    layers_.push_back(cells[2]);
    findSlabs();
  }

  /// Of the brick that has a cell of the grid.
  uint64_t keyOf(const Slab& cell) const { return rowOf(cell) * uint64_t(counts[0]) + at(cell, 0); }
  /// The number of the row along x that this brick lies in.
  uint64_t rowOf(const Slab& cell) const { return at(cell, 2) * uint64_t(counts[1]) + at(cell, 1); }
  BrickBox boxOf(uint64_t key) const {
    const uint64_t row = key / uint64_t(counts[0]);
    const std::array<uint64_t, 3> at = {key % uint64_t(counts[0]), row % uint64_t(counts[1]), row / uint64_t(counts[1])};
    BrickBox box;
    for (size_t d = 0; d < 2; ++d) {
      box.first[d] = int32_t(at[d]) << shifts[d];
      box.count[d] = std::min(int32_t(1) << shifts[d], cells[d] - box.first[d]);
    }
    box.first[2] = layers_[at[2]];
    box.count[2] = layers_[at[2] + 1] - layers_[at[2]];
    return box;
  }
  /// Whether a cell is one of the grid that is cut here.
  bool hasCell(const Slab& cell) const {
    const int32_t z = cell[2] >> 1;
    return uint32_t(cell[0] >> 1) < uint32_t(cells[0]) && uint32_t(cell[1] >> 1) < uint32_t(cells[1]) && z >= here.first && z < here.past;
  }
  /// Whether the inside of one brick has all slabs from one to another.
  bool isInsideOne(const Slab& least, const Slab& greatest) const {
    const int32_t at = slabAt(least[2]);
    int isInside = int(at == slabAt(greatest[2])) & at;  // without branches, which are hard to predict here
    for (size_t d = 0; d < 2; ++d) {
      const int32_t in = bits(d);
      isInside &= int(((least[d] ^ greatest[d]) & ~in) == 0) & int((least[d] & in) != 0);
      isInside &= int(least[d] >= 0) & int(greatest[d] < 2 * cells[d]);
    }
    return isInside != 0;
  }
  /// Calls f(cell) for the cells that are cut here and have a grid element, one of each brick.
  template <class F>
  void forBricks(const Slab& element, const F& f) const {
    Slab first, last;
    for (size_t d = 0; d < 3; ++d) {
      first[d] = element[d] - (onPlane(element[d]) && element[d] > 0);
      last[d] = isBetween(d, element[d]) ? element[d] + 1 : first[d];
      first[d] |= 1;
    }
    for (int32_t z = first[2]; z <= last[2]; z += 2) {
      for (int32_t y = first[1]; y <= last[1]; y += 2) {
        for (int32_t x = first[0]; x <= last[0]; x += 2) {
          if (hasCell({x, y, z})) f(Slab{x, y, z});
        }
      }
    }
  }
  /// Calls f(cell) for a brick and those around it, with a cell of each.
  template <class F>
  void forAround(const BrickBox& box, const F& f) const {
    const auto forSides = [&](size_t d, const auto& next) {
      for (const int32_t at : {box.first[d] - 1, box.first[d], box.first[d] + box.count[d]}) next(2 * at + 1);
    };
    forSides(2, [&](int32_t z) {
      forSides(1, [&](int32_t y) {
        forSides(0, [&](int32_t x) {
          if (hasCell({x, y, z})) f(Slab{x, y, z});
        });
      });
    });
  }
  /// Whether an element lies on a plane between bricks.
  bool isOnSeam(const Slab& element) const {
    bool isOn = false;
    for (size_t d = 0; d < 3; ++d) isOn |= isBetween(d, element[d]) && element[d] > 0 && element[d] < 2 * cells[d];
    return isOn;
  }
  /// Whether some of it may lie there: a slab beside such a plane.
  bool isBesideSeam(const Slab& element) const {
    bool isBeside = false;
    for (size_t d = 0; d < 3; ++d) isBeside |= isBetween(d, element[d] - 1) || isBetween(d, element[d]) || isBetween(d, element[d] + 1);
    return isBeside;
  }
  /// Whether a slab along an axis is a plane between bricks, or one of the first or the last of the grid.
  bool isBetween(size_t axis, int32_t slab) const {
    if (axis < 2) return (slab & bits(axis)) == 0;
    return onPlane(slab) && slab >= 0 && slab <= 2 * cells[2] && onPlane(slabAt(slab));
  }
  /// Whether cells from one to another, as slabs along an axis, are of one brick along it.
  bool isOneBrick(size_t axis, int32_t first, int32_t last) const { return placeOf(axis, first) == placeOf(axis, last); }
  /// The first plane between bricks, or at the end of the grid, that is not below a plane of the grid.
  int32_t planeFrom(size_t axis, int32_t plane) const {
    if (axis == 2) return layers_[size_t(slabAt(2 * plane) + 1) / 2];
    const int32_t in = (1 << shifts[axis]) - 1;
    return std::min((plane + in) & ~in, cells[axis]);
  }

 private:
  /// What slabs of planes between bricks have no bit of, along x and y.
  int32_t bits(size_t axis) const { return (2 << shifts[axis]) - 1; }
  /// Of a cell's brick among those along an axis.
  uint64_t at(const Slab& cell, size_t axis) const { return uint64_t(placeOf(axis, cell[axis])); }
  /// The place among bricks along an axis of the brick that has a cell's slab, or one in its inside.
  int32_t placeOf(size_t axis, int32_t slab) const { return axis < 2 ? slab >> 1 >> shifts[axis] : slabAt(slab | 1) >> 1; }
  /// Where a slab along z lies among the planes between bricks, as slabs do among those of the grid; beyond the grid, on its last plane.
  int32_t slabAt(int32_t slab) const { return slabs_[size_t(slab + 1)]; }
  void findSlabs() {
    slabs_.reserve(2 * size_t(cells[2]) + 3);
    slabs_.push_back(0);
    for (int32_t at = 0; at < counts[2]; ++at) {
      slabs_.push_back(2 * at);
      slabs_.insert(slabs_.end(), size_t(2 * (layers_[size_t(at) + 1] - layers_[size_t(at)]) - 1), 2 * at + 1);
    }
    slabs_.insert(slabs_.end(), 2, 2 * counts[2]);
  }

  /// Of bricks.
  static size_t countFor(const Input& input, const std::array<int, 3>& shifts) {
    const auto along = [&](int axis) { return size_t((input.cells(axis) - 1) >> shifts[size_t(axis)]) + 1; };
    return along(0) * along(1) * along(2);
  }

  std::vector<int32_t> layers_;  // the first of each brick along z, and where the last ends
  std::vector<int32_t> slabs_;   // see slabAt()
};

}  // namespace mandoline::detail
