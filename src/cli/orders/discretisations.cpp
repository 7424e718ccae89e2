#include "cli/orders/discretisations.h"

#include <algorithm>
#include <stdexcept>

namespace mandoline::orders {

CellComplex allCells(const Mesh& mesh, const Grid& grid, const Discretisation& way) {
  const CutResult result = cut(mesh, grid);
  if (!result) throw std::runtime_error(result.error.message);
  CoarsenOptions options;
  if (!way.isCoarsened) options.maxLevel = 0;
  CellComplex cells = cellComplex(mesh, result.mesh, coarsen(result.mesh, options));
  return way.isMerged ? mergeSmallCells(result.mesh, cells).cells : cells;
}

CellComplex outside(const CellComplex& cells) { return regionComplex(cells, cells.cellRegion.back()).cells; }

CellComplex inside(const CellComplex& cells) {
  const auto found =
      std::find_if(cells.cellRegion.begin(), cells.cellRegion.end(), [&](uint32_t r) { return r != cells.cellRegion.back(); });
  return regionComplex(cells, *found).cells;
}

}  // namespace mandoline::orders
