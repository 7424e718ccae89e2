// Cells of several sizes at the surface: grid cells divided where the surface bends, or where boxes or a function say so, before they are
// cut.
#pragma once

#include <functional>

#include "mandoline/cell_complex.h"
#include "mandoline/prepare.h"

namespace MANDOLINE_API mandoline {

/// Grid cells that meet the inside of a box are divided `levels` times.
struct RefinementBox {
  std::array<double, 3> min{}, max{};
  int levels = 0;
};

/// Grid cells are divided where a function says so.
struct RefinementRule {
  /// Whether a cell with these corners is divided, which is the outcome of `depth` divisions of a grid cell: asked of all grid cells, by z,
  /// then y, then x, and of those that it divided them into, one after the other on the caller's thread. What it throws passes through.
  std::function<bool(const std::array<double, 3>& min, const std::array<double, 3>& max, int depth)> divides;
  int levels = 0;  ///< how often it divides a grid cell at most, 1 to 24; 0 without a function
};

struct RefineOptions : RunOptions {
  /// How often grid cells are divided at most where the surface bends: as long as normals of triangles in the cell are farther from each
  /// other than `angle`. So they are at edges and corners, in thin parts with both sides in one cell, and where curvature is large.
  /// Triangles have to be consistently oriented: see PrepareOptions::orient.
  int levels = 0;
  double angle = 30;  ///< in degrees, 0 to 180; at 0 all cells with triangles are divided
  std::vector<RefinementBox> boxes;
  RefinementRule rule;
  int layers = 1;  ///< least layers of cells of each size, diagonally too, around where the surface bends and smaller ones; at least 1
  CoarsenOptions coarsening = uncoarsened();  ///< of untouched grid cells that are not divided; threads and progress are not read

  static CoarsenOptions uncoarsened() {
    CoarsenOptions options;
    options.maxLevel = 0;
    return options;
  }
};

/// What refineCells() made.
struct RefinedCells {
  /// All cells, as of one cut with cells of several sizes. cellLevel is 0 for the smallest cells; one of level L is 2^L of those on a side,
  /// also if it is a cut-cell. cellCorner counts the smallest ones.
  CellComplex cells;
  /// The cut-vertices, cut-faces and cut-cells of `cells`, for functions that take a cut-mesh together with its cells: writers,
  /// mergeSmallCells(), uniteWalls(), faceGroups(), streamlines(). Its grid has the planes of the smallest cells. It has no runs and no
  /// made vertices, and so is no cut of that grid: functions that need one, such as measure(), coarsen() and cellsAt(), refuse it. Of a
  /// vertex of a larger cell, planes that only smaller cells have are left out of vertexMask, and vertexCell is a rounded one along axes
  /// without a plane.
  CutMesh cutMesh;
  int levels = 0;  ///< how often grid cells were divided at most; those of the grid have this level

  static void fields(auto& self, const auto& f) {
    f("cells", self.cells);
    f("cutMesh", self.cutMesh);
    f("levels", self.levels);
  }
};

/// The grid with each cell divided into 2^levels along each axis: that of uniform cells if the grid is.
Grid dividedGrid(const Grid& grid, int levels);

/// Divides cells of the grid of `cutMesh`, a cut of `mesh` without snapping, and cuts them again where they are divided, and there alone.
/// Cells that share a part of a face differ by one level at most. Cells and faces are exact, as those of a cut with dividedGrid() are:
/// where a cell meets smaller ones, its faces are divided like theirs, and the edges of a face have all vertices that lie on them. Regions
/// are those of `cutMesh`, with their ids.
///
/// For solvers, boxes and rules should take parts of the surface as a whole, or end where it is flat: where cut-cells of two sizes meet,
/// errors are of first order, and after merging some faces may be slanted by more than 90 degrees from the line between centroids.
///
/// The result is the same to the bit for any number of threads. Throws CallError if an option is out of range, there are more than 2^24
/// of the smallest cells along an axis (gridTooLarge) or planes between those of the grid are not apart (badGrid), if the cut-mesh is
/// not one of the mesh, or was snapped, or its regions are divided by estimateInside(), or its grid is smaller than 1e-70 or larger than
/// 1e70 (badArgument), if faces have 2^31 corners or more (meshTooLarge), as cut() has errors, or if cancelled.
RefinedCells refineCells(const PreparedMesh& mesh, const CutMesh& cutMesh, const RefineOptions& options = {});

}  // namespace mandoline
