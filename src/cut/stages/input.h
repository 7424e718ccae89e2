// The grid: checks it, scales its planes like the mesh, finds all vertices' slabs, and what winds around its lowest corner.
//
// In: the user's grid, and Prepared. Out: Input, or a Failure that names the offending axis.
#pragma once

#include "base/shared.h"
#include "cut/scaled_input.h"

namespace mandoline::detail {

/// Ends the cut where the grid or the options are not usable.
MANDOLINE_SHARED void checkGrid(const Grid& grid, double snapTolerance);
/// The largest coordinate of a plane.
double largestCoordinate(const Grid& grid);
/// The slabs of an input before, of a mesh with the same scale in the same grid.
struct KnownSlabs {
  const Input& input;
  const Moved& moved;  ///< since then
};

/// The grid's planes. Throws Failure{badGrid} where scaling brings some together.
std::array<std::vector<double>, 3> scaledPlanes(const Grid& grid, const Scale& scale, uint32_t& flushed);
/// Finds slabs of points among scaled planes, which must outlive it.
class SlabFinder {
 public:
  explicit SlabFinder(const std::array<std::vector<double>, 3>& planes);
  Slab find(const Point& p) const;

 private:
  const std::array<std::vector<double>, 3>& planes_;
  double perCell_[3];
};
/// `known` may be null. The planes must fit the mesh's scale: largestCoordinate(grid) * 2^shift < 2^(Scale::kLargestExponent + Scale::kRoom
/// + 1).
Input prepareInput(const Prepared& mesh, const Grid& grid, Run& run, const KnownSlabs* known = nullptr);

}  // namespace mandoline::detail
