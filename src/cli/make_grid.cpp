#include "cli/make_grid.h"

#include <algorithm>
#include <cmath>

namespace mandoline::cli {
namespace {

using Vector = GridArguments::Vector;

constexpr int64_t kMostCells = int64_t(1) << 24;  // along an axis of a grid

/// n along the longest side, and as many along the others as make the cells nearly cubic.
std::array<int64_t, 3> nearlyCubic(const std::array<Vector, 2>& box, int64_t n) {
  Vector sides;
  for (size_t d = 0; d < 3; ++d) sides[d] = box[1][d] - box[0][d];
  const double longest = *std::max_element(sides.begin(), sides.end());
  std::array<int64_t, 3> cells;
  for (size_t d = 0; d < 3; ++d) cells[d] = std::max(int64_t(1), int64_t(std::llround(double(n) * (sides[d] / longest))));
  return cells;
}

std::array<Vector, 2> grownBox(const Mesh& mesh, double margin) {
  const MeshBox meshBox = boxOf(mesh);
  std::array<Vector, 2> box = {meshBox.min, meshBox.max};
  double longest = 0;
  for (size_t d = 0; d < 3; ++d) longest = std::max(longest, box[1][d] - box[0][d]);
  if (!(longest > 0)) longest = 1;
  for (size_t d = 0; d < 3; ++d) {
    box[0][d] -= margin * longest;
    box[1][d] += margin * longest;
  }
  return box;
}

AskedGrid withItsCells(Grid&& grid) {
  const std::array<int64_t, 3> cells = {grid.cells(0), grid.cells(1), grid.cells(2)};
  return {std::move(grid), cells};
}

AskedGrid makeAround(const Mesh& mesh, int64_t n, double margin) {
  AskedGrid asked = withItsCells(Grid::around(mesh, n, margin));
  const auto [low, high] = grownBox(mesh, margin);
  for (size_t d = 0; d < 3; ++d) {
    if (asked.cells[d] <= kMostCells) continue;
    const double count = std::ceil((high[d] - low[d]) / asked.grid.spacing[d]);
    asked.cells[d] = count < double(n) ? int64_t(count) : n;
  }
  return asked;
}

}  // namespace

AskedGrid makeGrid(const GridArguments& arguments, const Mesh& mesh) {
  constexpr int64_t kDefaultCells = 32;
  if (arguments.planes) return withItsCells(Grid::rectilinear(*arguments.planes));
  if (arguments.origin) return {Grid::regular(*arguments.origin, *arguments.spacing, *arguments.cells), *arguments.cells};
  const bool oneNumber = arguments.oneNumber || !arguments.cells;
  const int64_t n = arguments.cells ? (*arguments.cells)[0] : kDefaultCells;
  const double margin = arguments.margin.value_or(0.05);
  if (oneNumber && !arguments.box) return makeAround(mesh, n, margin);
  const auto [low, high] = arguments.box ? *arguments.box : grownBox(mesh, margin);
  const std::array<int64_t, 3> cells = oneNumber ? nearlyCubic({low, high}, n) : *arguments.cells;
  return {Grid::box(low, high, cells), cells};
}

GridArguments flowGrid(GridArguments grid) {
  constexpr double kMargin = 0.5;  // in longest sides of the mesh
  if (!grid.margin) grid.margin = kMargin;
  return grid;
}

}  // namespace mandoline::cli
