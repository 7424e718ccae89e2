// The triangles around the cut-cells of a grid cell, and which of the cells a point lies in.
//
// A point's cut-cell is the one whose closed triangle surface winds around it: a ray runs upwards from the point, and every triangle that
// it meets adds to the winding number of the cell below and takes from that of the cell above.
//
// The point is moved by less than anything, first along z, then far less along x, then far less along y (simulation of simplicity), into
// the grid cell where it lies on the grid cell's border. So the ray meets no edge and the point lies on no triangle. Together, the surfaces
// of a grid cell's cut-cells are the surface of its box, so the winding numbers add up to 1: some cell has a positive one, even where
// rounded positions let cells overlap.
#pragma once

#include <algorithm>

#include "base/csr.h"
#include "base/shared.h"
#include "grid/scaled_space.h"
#include "operators/triangulate/face_triangulator.h"

namespace mandoline::operators {

/// A triangle and the cut-cells of the grid cell on its two sides, as places in that grid cell; kNone outside it.
struct Wall {
  std::array<ScaledPoint, 3> corners;
  std::array<uint32_t, 2> places;
};

using GridCell = std::array<int32_t, 3>;

/// The grid cell of a point; false outside the grid.
inline bool findGridCell(const Grid& grid, const double* point, GridCell& gridCell) {
  for (size_t d = 0; d < 3; ++d) {
    const std::vector<double>& planes = grid.planes[d];
    if (!(point[d] >= planes.front() && point[d] <= planes.back())) return false;
    const auto next = std::upper_bound(planes.begin(), planes.end() - 1, point[d]);
    gridCell[d] = int32_t(next - planes.begin()) - 1;
  }
  return true;
}

/// The triangles of a grid cell's cut-cells, or those of a block of refined ones, that the rays of some points may meet, in square bins,
/// seen along the rays.
class Walls {
 public:
  static constexpr uint32_t kNone = ~0u;

  Walls(const CutMesh& cutMesh, const ScaledSpace& space) : cutMesh_(cutMesh), space_(space), triangulator_(cutMesh.positions) {}

  /// Loads what lies around the cut-cells, which are all of a block of so many grid cells on a side, to be asked about some points of it.
  MANDOLINE_SHARED void load(const IdRange& cells, int32_t blockSize, const std::vector<ScaledPoint>& points);
  /// The place of the cut-cell that holds one of the points; kNone only if the cut-mesh is not valid.
  MANDOLINE_SHARED uint32_t cellAt(const ScaledPoint& point);

 private:
  struct HalfFace {
    uint32_t halfFace, place;
  };
  struct Box {
    ScaledPoint low, high;
  };

  void gatherFaces(const IdRange& cells);
  bool mayBeMet(uint32_t face) const;
  void addWalls(uint32_t face, const std::array<uint32_t, 2>& places);
  void makeBins(size_t points);
  uint32_t binOf(const ScaledPoint& p, int axis) const;
  template <class F>
  void forBins(const Wall& wall, const F& f) const;
  size_t binEntries() const;
  void add(uint32_t place, int winding);

  const CutMesh& cutMesh_;
  const ScaledSpace& space_;
  FaceTriangulator triangulator_;
  detail::Predicates predicates_;
  Box block_{}, points_{};
  std::vector<HalfFace> halfFaces_;
  std::vector<uint32_t> triangles_;
  std::vector<Wall> walls_;
  uint32_t binCount_ = 1;
  detail::Csr<uint32_t> bins_;
  std::vector<int> winding_;   // per place
  std::vector<uint32_t> met_;  // places with a wall above the point
};

}  // namespace mandoline::operators
