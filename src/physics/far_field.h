// What stands in a wind disturbs it far away as dipoles do.
#pragma once

#include <functional>
#include <optional>

#include "base/box_tree.h"
#include "base/shared.h"
#include "mandoline/flow.h"
#include "physics/fit_data.h"
#include "physics/secants.h"

namespace mandoline::physics {

/// The cells of one of several processes, ghosts among them; or all cells.
struct FarFieldShare {
  CellComponents parts;     ///< partsBetweenSlits() of the whole, per cell here
  std::vector<char> isOwn;  ///< per cell: whether it counts in this process, with its faces to the boundary; empty for all
  /// Sums, and least numbers, over all processes, each in its place; null for one process.
  std::function<void(std::vector<double>&)> sum, least;

  bool owns(size_t cell) const { return isOwn.empty() || isOwn[cell]; }
};

/// A face of the walls that reaches a side of the box, which there must not be with the far field.
MANDOLINE_SHARED std::optional<uint32_t> wallOnSide(const CellComplex& cells, const Boundary& boundary, const FarFieldShare& share);

/// In unbounded space, the potential flow of a wind past walls is the wind and the flow of dipoles on the walls: phi times the normal that
/// points into the fluid. Those in a block of space count as one in their middle.
class MANDOLINE_SHARED FarField {
 public:
  /// Walls are what of the boundary is no side of the box; none reaches a side, as of wallOnSide(). All that several processes do with
  /// theirs is collective, and all know the same dipoles.
  FarField(const CellComplex& cells, const Boundary& boundary, const FarFieldShare& share);

  bool hasDipoles() const { return !centres_.empty(); }

  /// Per half-face of the boundary: its share of the area of the sides; 0 for walls, and for sides of other processes.
  std::vector<double> sideWeights() const;

  /// Per half-face of the boundary: how fast the flow of the dipoles passes out of the sides, as much into each part as out of it; 0 for
  /// walls. Nothing passes the walls in `flow`.
  std::vector<double> outflowOfDipoles(const Flow& flow) const;

  /// Over all processes.
  double sum(double number) const;

 private:
  struct Side {
    uint32_t at, face;  ///< its place in the boundary
    uint32_t part;      ///< of partsBetweenSlits()
    bool isOwn;
    Point normal;  ///< out of the box
  };

  static void overAll(const std::function<void(std::vector<double>&)>& make, std::vector<double>& numbers) {
    if (make) make(numbers);
  }

  void placeBlocks(const detail::Box& box, const detail::Box& wallBox);
  size_t blockOf(size_t cell) const;
  void placeDipoles(const std::vector<uint32_t>& walls);
  std::vector<double> moments(const Flow& flow) const;
  std::vector<Point> quadratureOn(size_t face) const;
  void takeExcess(std::vector<double>& outflow) const;

  const CellComplex& cells_;
  const FarFieldShare& share_;
  size_t boundarySize_;
  std::vector<Side> sides_;  ///< those of ghosts, too
  Point low_{}, middle_{};   ///< of the walls' box
  double size_ = 0;          ///< its longest side
  double edge_ = 0;          ///< of a block
  std::array<size_t, 3> blockCounts_{};
  std::vector<int32_t> cellDipole_;  ///< per cell: that of its block, or -1
  std::vector<double> centres_;      ///< 3 per dipole
};

/// What passes out of the sides follows from dipoles, and these follow from the flow: found in passes.
class FarFieldPasses {
 public:
  enum class Next { pass, done, limit };

  /// `ofWind`: what passes out of the sides without dipoles. Keeps a reference to the far field.
  MANDOLINE_SHARED FarFieldPasses(const FarField& farField, std::vector<double> ofWind);

  /// Takes a flow with `outflow`, at first that of the wind alone, which becomes that of the next pass.
  MANDOLINE_SHARED Next add(const Flow& flow, std::vector<double>& outflow);

  /// The share of dipoles in the last outflow.
  const std::vector<double>& ofDipoles() const { return ofDipoles_; }

 private:
  static constexpr double kEnough = 1e-4;  ///< so much of the wind may be missing on the sides, in the quadratic mean
  static constexpr int kMaxPasses = 20;

  const FarField& farField_;
  const std::vector<double> ofWind_;
  std::vector<double> ofDipoles_;
  Secants secants_;
  int pass_ = 0;
};

}  // namespace mandoline::physics
