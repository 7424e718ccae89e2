#include <algorithm>

#include "catch.h"
#include "staged_cut.h"

using namespace stages;

namespace {

/// Number of half-faces of each cut-cell in a grid cell, ascending.
std::vector<size_t> sizesIn(const StagedCut& cut, const Slab& gridCell) {
  std::vector<size_t> sizes;
  for (const CellId c : cut.cells.gridCells.ids()) {
    if (cut.stencil.cells[cut.cells.gridCells[c]].element == gridCell) sizes.push_back(cut.cells.halfFaces[c].size());
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// A square sheet at height z through all of the grid.
Mesh sheetAt(double z) { return shapes::quad({-1, -1, z}, {4, -1, z}, {4, 4, z}, {-1, 4, z}); }

}  // namespace

TEST_CASE("A sheet splits a grid cell in two, two sheets in three", "[stages][cutCells]") {
  CHECK(sizesIn(StagedCut(sheetAt(1.5), Stage::cutCells), {1, 3, 3}).size() == 2);
  CHECK(sizesIn(StagedCut(shapes::merged({sheetAt(1.25), sheetAt(1.75)}), Stage::cutCells), {1, 3, 3}).size() == 3);
}

TEST_CASE("A sheet that ends within a grid cell leaves it one cell, with both of the sheet's sides", "[stages][cutCells]") {
  const StagedCut cut(shapes::triangle({1.25, 1.5, 1.25}, {1.75, 1.5, 1.25}, {1.5, 1.5, 1.75}), Stage::cutCells);
  CHECK(sizesIn(cut, {3, 3, 3}) == std::vector<size_t>{6 + 2});
}

TEST_CASE("A bubble is one cell, and a cavity of the cell around it", "[stages][cutCells]") {
  const StagedCut cut(shapes::octahedron({1.5, 1.5, 1.5}, 0.25), Stage::cutCells);
  CHECK(sizesIn(cut, {3, 3, 3}) == std::vector<size_t>{8, 6 + 8});
}

TEST_CASE("A bubble in a bubble", "[stages][cutCells]") {
  const Mesh mesh = shapes::merged({shapes::octahedron({1.5, 1.5, 1.5}, 0.25), shapes::octahedron({1.5, 1.5, 1.5}, 0.125)});
  CHECK(sizesIn(StagedCut(mesh, Stage::cutCells), {3, 3, 3}) == std::vector<size_t>{8, 6 + 8, 8 + 8});
}

TEST_CASE("Three blades on one edge make three cells", "[stages][cutCells]") {
  const Mesh fan = shapes::fan({1.5, 1.5, -1}, 5, {{3, 0.25}, {-3, 1}, {-3, -2}});
  CHECK(sizesIn(StagedCut(fan, Stage::cutCells), {3, 3, 3}).size() == 3);
}

TEST_CASE("Every half-face of a tri-cut-face inside the grid has one cell", "[stages][cutCells]") {
  const StagedCut cut(shapes::icosphere({1.5, 1.5, 1.5}, 1.2, 2), Stage::cutCells);
  std::vector<int> owners(2 * cut.faces().size(), 0);
  for (const HalfFace h : cut.cells.halfFaces.items) ++owners[h.number];
  for (size_t h = 0; h < 2 * cut.brick.triFaces.size(); ++h) CHECK(owners[h] == 1);
  for (const int count : owners) CHECK(count <= 1);
}
