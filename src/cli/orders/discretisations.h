// The cells of a mesh, made in each of the ways that are compared.
#pragma once

#include <iterator>

#include "mandoline/mandoline.h"

namespace mandoline::orders {

/// How the cells are made: as by the library's defaults, but for what is said.
struct Discretisation {
  const char* name;
  bool isCoarsened, isMerged;
};
inline constexpr Discretisation kDiscretisations[] = {
    {"grid cells", false, false}, {"octree cells", true, false}, {"merged", false, true}, {"octree cells, merged", true, true}};
inline constexpr size_t kWays = std::size(kDiscretisations);

/// Throws std::runtime_error if the mesh can't be cut.
CellComplex allCells(const Mesh& mesh, const Grid& grid, const Discretisation& way);
/// The region of the grid's last untouched cell, which is the outside.
CellComplex outside(const CellComplex& cells);
/// The region of the first cut-cell that is not of the outside.
CellComplex inside(const CellComplex& cells);

}  // namespace mandoline::orders
