// Cells for solvers: small ones merged with neighbours, and the many pieces of triangles that bound a cell united to a few faces.
#pragma once

#include "mandoline/cell_complex.h"

namespace MANDOLINE_API mandoline {

struct MergeOptions : RunOptions {
  double fraction = 0.2;  ///< of its grid cell's volume: cells below it are small. 0 to 0.5; at 0 none is
};

/// What mergeSmallCells() made.
struct MergedCells {
  CellComplex cells;                 ///< the merged ones
  std::vector<uint32_t> mergedCell;  ///< per cell before: the cell that it is a member of
  std::vector<uint32_t> pockets;     ///< cells that are still small, ascending

  static void fields(auto& self, const auto& f) {
    f("cells", self.cells);
    f("mergedCell", self.mergedCell);
    f("pockets", self.pockets);
  }
};

/// Merges small cut-cells with neighbours until no cell is small. `cells` are all of the cut-mesh's, none of them merged.
///
/// A merged cell has at least `fraction` of the volume of a grid cell, and at most 1 + 2.5 * `fraction` of it, which is 1.5 by default:
/// that of the grid cell, or larger cell (see coarsen() and refineCells()), of its base, whose cellCorner, cellLevel and cellCentre it has.
/// The base is its member of the largest volume, but an octree cell if it has one; none has two.
///
/// Cells merge through faces of the grid alone, within a region, and never two that a triangle separates: both sides of a triangle belong
/// to one cell only where they did before. So a cell stays small where the cells around it that it could join are small as a whole, as in a
/// pocket closed by triangles, or have no room left.
///
/// Of the neighbours, one is chosen across which the faces that remain stay nearly perpendicular to the lines between centroids, and which
/// shares a large area. Then, where a face is more than 60 degrees from that, or nearly in one plane with a centroid, cells move from one
/// merged cell to another as long as faces get better, one by one or two at once; where that is not enough, a merged cell joins a neighbour
/// though both are large enough. Where triangles leave no other way, such faces remain.
///
/// Volumes are sums, centroids are weighted by volume. Faces inside a merged cell vanish. Those between the same two cells, or on one side
/// of the grid, that lie in one plane become one face where that has one simple loop. Vertices stay as they are; some are in no face then.
///
/// Lines between dual points are slanted where merged cells meet, so operators have an error of first order there. solvePoisson() and
/// solveFlow() correct it: errors are those of cells that are not merged, or smaller.
///
/// The result is the same to the bit for any number of threads. Throws CallError if the fraction is out of range (badOption), if the cells
/// are not all of the cut-mesh's, are merged already, or together are smaller than 1e-70 or larger than 1e70 (badArgument), or if
/// cancelled.
MergedCells mergeSmallCells(const CutMesh& cutMesh, const CellComplex& cells, const MergeOptions& options = {});

struct WallOptions : RunOptions {
  double angle = 30;  ///< in degrees, 0 to 90: how far normals may be from that of the first piece
  /// Per triangle of the input: its group, e.g. TriangleGroups::triangleGroup; pieces of different groups stay apart. Empty for one group.
  std::span<const uint32_t> triangleGroup;
};

/// The same cells with fewer faces: pieces of triangles that are between the same two cells, on the same sides of them, and hang together
/// through edges without other faces, become one face with one simple loop, which need not be flat. `cells` are all of the cut-mesh's,
/// merged or not; merge them first.
///
/// The area vector, faceArea * faceNormal, is the sum of those of the pieces, so each cell is as closed as before. The centroid is that of
/// the pieces, moved along the normal to where the divergence theorem gives cells the volumes that they have. Where a fan of triangles in
/// the loop would change the volume of a cell by more than a tenth, the angle is halved for its pieces, or they stay as they are.
///
/// The result is the same to the bit for any number of threads. Throws CallError if the angle is out of range (badOption), if the cells are
/// not all of the cut-mesh's, or together are smaller than 1e-70 or larger than 1e70, or the groups not those of its triangles
/// (badArgument), or if cancelled.
CellComplex uniteWalls(const CutMesh& cutMesh, const CellComplex& cells, const WallOptions& options = {});

}  // namespace mandoline
