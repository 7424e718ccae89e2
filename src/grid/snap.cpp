#include "grid/snap.h"

#include "grid/scaled_space.h"

namespace mandoline::detail {
namespace {

/// The planes along an axis, which coordinates are compared with after both were scaled.
class Planes {
 public:
  Planes(const std::vector<double>& planes, const operators::ScaledSpace& space) : world_(planes), space_(space) {
    for (const double x : planes) planes_.push_back(space.scaled(x));
  }

  /// Returns how far the coordinate was moved, in cells; 0 if it was not.
  double snap(double& coordinate, double tolerance) const {
    const double x = space_.scaled(coordinate);
    const int32_t last = int32_t(planes_.size()) - 1;
    if (last < 1) return 0;  // of a grid without cells
    const int32_t below = int32_t(std::upper_bound(planes_.begin(), planes_.end(), x) - planes_.begin()) - 1;
    const int32_t cell = std::clamp(below, 0, last - 1);
    double nearest = tolerance;
    int32_t plane = -1;
    for (int32_t p = std::max(0, below); p <= std::min(last, below + 1); ++p) {
      const double distance = std::fabs(x - planes_[size_t(p)]) / (planes_[size_t(cell) + 1] - planes_[size_t(cell)]);
      if (distance <= nearest) nearest = distance, plane = p;
    }
    if (plane < 0 || x == planes_[size_t(plane)]) return 0;
    coordinate = world_[size_t(plane)];
    return nearest;
  }

 private:
  const std::vector<double>& world_;
  const operators::ScaledSpace& space_;
  std::vector<double> planes_;
};

}  // namespace

SnappedMesh snapped(const MeshView& mesh, const Grid& grid, double tolerance) {
  SnappedMesh result{{{mesh.positions.begin(), mesh.positions.end()}, {mesh.triangles.begin(), mesh.triangles.end()}}};
  const operators::ScaledSpace space(grid);
  const std::array<Planes, 3> planes{Planes(grid.planes[0], space), Planes(grid.planes[1], space), Planes(grid.planes[2], space)};
  std::vector<double>& positions = result.mesh.positions;
  for (size_t v = 0; v < result.mesh.vertexCount(); ++v) {
    double farthest = 0;
    for (size_t d = 0; d < 3; ++d) farthest = std::max(farthest, planes[d].snap(positions[3 * v + d], tolerance));
    result.vertices += farthest > 0;
    result.largest = std::max(result.largest, farthest);
  }
  return result;
}

}  // namespace mandoline::detail
