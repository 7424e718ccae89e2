// Rectilinear grids.
#pragma once

#include <array>

#include "mandoline/mesh.h"

namespace MANDOLINE_API mandoline {

/// A rectilinear grid: per axis d the ascending coordinates of its cells[d] + 1 axial planes (paper, 3.1). These doubles are the grid:
/// every decision compares input doubles with them. Grid cell (i, j, k) spans planes[0][i] .. planes[0][i + 1] and so on.
struct Grid {
  std::array<std::vector<double>, 3> planes;
  bool uniform = false;  ///< whether origin and spacing describe it

  std::array<double, 3> origin{};   ///< its lowest corner
  std::array<double, 3> spacing{};  ///< size of a cell per axis; zero if not uniform

  /// The box from min to max in cells[d] cells per axis: per axis, plane c lies at min + (max - min) * c / cells.
  static Grid box(const std::array<double, 3>& min, const std::array<double, 3>& max, const std::array<int64_t, 3>& cells);
  /// Per axis, plane c lies at origin + spacing * c.
  static Grid regular(const std::array<double, 3>& origin, const std::array<double, 3>& spacing, const std::array<int64_t, 3>& cells);
  /// Any ascending planes, for graded grids.
  static Grid rectilinear(std::array<std::vector<double>, 3> planes);
  /// Cubic cells around the mesh's bounding box and a margin all around it, in longest sides of the box: n along the longest side, as many
  /// along the others as cover it, centred: of size (1 + 2 margin) x longest side / n. A margin below 0 or above 1e6 leaves no cells.
  static Grid around(const MeshView& mesh, int64_t n, double margin = 0.05);

  /// Number of grid cells along an axis (0 for a grid that could not be made, which cut() reports).
  int64_t cells(int axis) const { return planes[axis].empty() ? 0 : int64_t(planes[axis].size()) - 1; }
};

}  // namespace mandoline
