// What stands in a wind disturbs it far away as dipoles do.
#pragma once

#include "base/box_tree.h"
#include "mandoline/flow.h"
#include "physics/fit_data.h"

namespace mandoline::physics {

/// In unbounded space, the potential flow of a wind past walls is the wind and the flow of dipoles on the walls: phi times the normal that
/// points into the fluid. Those in a block of space count as one in their middle.
class FarField {
 public:
  /// Walls are what of the boundary is no side of the box. Throws CallError{badArgument} for one that reaches a side.
  FarField(const CellComplex& cells, const Boundary& boundary);

  bool hasDipoles() const { return !centres_.empty(); }

  /// Per half-face of the boundary: its share of the area of the sides; 0 for walls.
  std::vector<double> sideWeights() const;

  /// Per half-face of the boundary: how fast the flow of the dipoles passes out of the sides, as much into each part as out of it; 0 for
  /// walls. Nothing passes the walls in `flow`.
  std::vector<double> outflowOfDipoles(const Flow& flow) const;

 private:
  struct Side {
    uint32_t at, face;  ///< its place in the boundary
    uint32_t part;      ///< of partsBetweenSlits()
    Point normal;       ///< out of the box
  };

  void placeBlocks(const detail::Box& box, const detail::Box& wallBox);
  size_t blockOf(size_t cell) const;
  void placeDipoles(const std::vector<uint32_t>& walls);
  std::vector<double> moments(const Flow& flow) const;
  std::vector<Point> quadratureOn(size_t face) const;
  void takeExcess(std::vector<double>& outflow) const;

  const CellComplex& cells_;
  size_t boundarySize_;
  std::vector<Side> sides_;
  Point low_{}, middle_{};  ///< of the walls' box
  double size_ = 0;         ///< its longest side
  double edge_ = 0;         ///< of a block
  std::array<size_t, 3> blockCounts_{};
  std::vector<int32_t> cellDipole_;  ///< per cell: that of its block, or -1
  std::vector<double> centres_;      ///< 3 per dipole
};

}  // namespace mandoline::physics
