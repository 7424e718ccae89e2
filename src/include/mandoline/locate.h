// Which cell of a cut-mesh holds a point.
#pragma once

#include <span>
#include <vector>

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// Where points lie. A point on a face or on a plane of the grid belongs to one of the cells beside it, always the same one.
struct Locations {
  std::vector<int32_t> cell;      ///< per point: the cut-cell that holds it, or -1 in an untouched grid cell, or outside the grid
  std::vector<int32_t> gridCell;  ///< 3 per point: the grid cell, or -1, -1, -1 outside the grid
  std::vector<int32_t> region;    ///< per point: the region, or -1 outside the grid

  static void fields(auto& self, const auto& f) {
    f("cell", self.cell);
    f("gridCell", self.gridCell);
    f("region", self.region);
  }
};

/// `points`: 3 per point, world units; one that is not finite lies outside. The grid's border belongs to it. Decided exactly, by the
/// triangles of triangulateFaces(): a point in a cut grid cell is in just one of its cut-cells, even where rounding has moved vertices.
/// One call for many points is faster than many calls. Throws CallError unless the number of coordinates is a multiple of 3.
Locations cellsAt(const CutMesh& cutMesh, std::span<const double> points);

}  // namespace mandoline
