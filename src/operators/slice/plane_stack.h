// Parallel planes, and which boxes of the grid each of them cuts.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "base/csr.h"
#include "base/shared.h"
#include "operators/slice/cutting_plane.h"

namespace mandoline::operators {

/// The planes of a grid in scaled space.
struct ScaledGrid {
  std::array<std::vector<double>, 3> planes;

  ScaledGrid(const Grid& grid, const ScaledSpace& space);
  ScaledPoint corner(size_t i, size_t j, size_t k) const { return {planes[0][i], planes[1][j], planes[2][k]}; }
  ScaledPoint corner(const std::array<int32_t, 3>& at) const { return corner(size_t(at[0]), size_t(at[1]), size_t(at[2])); }
};

/// Throws CallError unless the normal has a direction.
MANDOLINE_SHARED void requireNormal(const std::array<double, 3>& normal);

/// The planes that may meet the grid, by ascending offset. Throws CallError for a normal without a direction and offsets that are no
/// numbers.
class PlaneStack {
 public:
  using Box = std::array<ScaledPoint, 2>;  // lowest and highest corner

  PlaneStack(const std::array<double, 3>& normal, std::span<const double> offsets, const Grid& grid, const ScaledSpace& space);

  size_t size() const { return planes_.size(); }
  const CuttingPlane& operator[](size_t p) const { return planes_[p]; }
  /// Which of the given offsets the plane has.
  size_t given(size_t p) const { return given_[p]; }

  /// How many planes, the first ones, lie below a point.
  uint32_t countBelow(const ScaledPoint& p) const;

  /// Per plane, which of `count` boxes have corners on both of its sides, ascending. `boxOf(b)` is a Box.
  template <class BoxOf>
  detail::Csr<uint32_t> boxesCut(size_t count, const BoxOf& boxOf) const {
    std::vector<std::pair<uint32_t, uint32_t>> planesOf;  // per box
    planesOf.reserve(count);
    for (size_t b = 0; b < count; ++b) planesOf.push_back(planesThrough(boxOf(b)));
    return boxesOf(planesOf);
  }

 private:
  /// First and one past the last.
  std::pair<uint32_t, uint32_t> planesThrough(const Box& box) const;
  detail::Csr<uint32_t> boxesOf(const std::vector<std::pair<uint32_t, uint32_t>>& planesOf) const;

  std::vector<CuttingPlane> planes_;
  std::vector<double> offsets_;  // of planes_
  std::vector<size_t> given_;
};

/// What cutting a cut-mesh with parallel planes starts with. Throws CallError for a cut-mesh that holds nothing, and as PlaneStack does.
struct PlanarCuts {
  PlanarCuts(const CutMesh& cutMesh, const std::array<double, 3>& normal, std::span<const double> offsets);
  PlanarCuts(const PlanarCuts&) = delete;

  const ScaledSpace space;
  const ScaledGrid grid;
  const PlaneStack planes;
  const detail::Csr<uint32_t> cells;  ///< per plane, the cut-cells in the grid cells that have corners on both of its sides, ascending
};

}  // namespace mandoline::operators
