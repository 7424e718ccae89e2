// The grid that was asked for.
#pragma once

#include "cli/arguments.h"
#include "mandoline/inspect.h"

namespace mandoline::cli {

struct AskedGrid {
  Grid grid;
  std::array<int64_t, 3> cells;  ///< along each axis, as they were asked for: a grid that is too large does not have them
};

AskedGrid makeGrid(const GridArguments& arguments, const Mesh& mesh);

/// With the margin that makes a wind tunnel, unless another one is given.
GridArguments flowGrid(GridArguments grid);

}  // namespace mandoline::cli
