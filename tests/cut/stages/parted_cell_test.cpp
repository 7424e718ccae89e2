#include "cut/stages/parted_cell.h"

#include "catch.h"
#include "same_bits.h"
#include "staged_cut.h"

using namespace stages;

namespace {

/// A sheet through all of the grid, as one triangle, and its normal along +z.
Mesh largeTriangle(double z) { return shapes::triangle({-5, -4, z}, {9, -3, z}, {1, 12, z}); }

bool isParted(const StagedCut& cut, const Slab& gridCell) {
  PartedCell parted;
  parted.begin(cut.brick, cut.stencil);
  return parted.find(cut.brick, cut.stencil, cut.gridFaces, *cut.stencil.find(gridCell));
}

/// How many of the touched grid cells are found to be parted.
size_t partedCells(const StagedCut& cut) {
  PartedCell parted;
  parted.begin(cut.brick, cut.stencil);
  size_t count = 0;
  for (const GridCellId c : cut.stencil.cells.ids()) count += parted.find(cut.brick, cut.stencil, cut.gridFaces, c);
  return count;
}
size_t partedCells(const Mesh& mesh) { return partedCells(StagedCut(mesh, Stage::gridFaces)); }

void checkSameAsGeneral(const Mesh& mesh, const CutOptions& options = unresolved()) {
  Way onlyGeneral(options);
  onlyGeneral.onlyGeneral = true;
  CHECK(differences(cutMeshOf(mesh, unitCells(), onlyGeneral), cutMeshOf(mesh, unitCells(), options)).empty());
}

}  // namespace

TEST_CASE("A sheet parts its cells, and grid-faces have the side of their cut-cell", "[stages][partedCell]") {
  const StagedCut cut(largeTriangle(1.5), Stage::gridFaces);
  CHECK(partedCells(cut) == 9);
  PartedCell parted;
  parted.begin(cut.brick, cut.stencil);
  REQUIRE(parted.find(cut.brick, cut.stencil, cut.gridFaces, *cut.stencil.find({3, 3, 3})));
  const auto sides = parted.sides();
  REQUIRE(sides.size() == 4 * 2 + 2);
  CHECK(std::count(sides.begin(), sides.end(), PartedCell::inFront) == 5);
  CHECK(sides[8] == PartedCell::behind);  // below the sheet
  CHECK(sides[9] == PartedCell::inFront);
}

TEST_CASE("Many triangles are one sheet", "[stages][partedCell]") {
  const Mesh sphere = shapes::icosphere({1.52, 1.47, 1.55}, 1.2, 3);
  const StagedCut cut(sphere, Stage::gridFaces);
  CHECK(cut.stencil.cells.size() == 26);
  CHECK(partedCells(cut) == 26);
  checkSameAsGeneral(sphere);
}

TEST_CASE("Two sheets, a bubble and a rim do not part a cell in two", "[stages][partedCell]") {
  CHECK(partedCells(shapes::merged({largeTriangle(1.25), largeTriangle(1.75)})) == 0);
  CHECK(partedCells(shapes::octahedron({1.5, 1.5, 1.5}, 0.25)) == 0);
  CHECK(partedCells(shapes::triangle({1.25, 1.5, 1.25}, {1.75, 1.5, 1.25}, {1.5, 1.5, 1.75})) == 0);
  const StagedCut fan(shapes::fan({1.53, 1.51, -1}, 5, {{3, 0.25}, {-3, 1}, {-3, -2}}), Stage::gridFaces);
  CHECK_FALSE(isParted(fan, {3, 3, 3}));
  Mesh holed;  // a triangular hole inside of the cell
  holed.positions = {-5, -4, 1.5, 9, -3, 1.5, 1, 12, 1.5, 1.4, 1.4, 1.5, 1.6, 1.4, 1.5, 1.5, 1.6, 1.5};
  holed.triangles = {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 2, 0, 5, 0, 3, 5};
  CHECK_FALSE(isParted(StagedCut(holed, Stage::gridFaces), {3, 3, 3}));
  CHECK(partedCells(holed) == 8);
  CHECK(partedCells(fan) > 0);
}

TEST_CASE("Sheets with a curve each are not taken for one", "[stages][partedCell]") {
  // At corners of the cell, where each curve is in three grid-faces, and at grid-edges, where it begins and ends on one side of each.
  const Mesh atCorners = shapes::merged({shapes::octahedron({1.03, 1.02, 0.99}, 0.4), shapes::octahedron({2.03, 2.02, 1.99}, 0.4)});
  const Mesh atEdges = shapes::merged({shapes::octahedron({1.5, 1.03, 1.02}, 0.3), shapes::octahedron({1.5, 1.97, 1.98}, 0.3)});
  for (const Mesh& mesh : {atCorners, atEdges}) {
    const StagedCut cut(mesh, Stage::gridFaces);
    CHECK_FALSE(isParted(cut, {3, 3, 3}));
    CHECK(partedCells(cut) == cut.stencil.cells.size() - 1);
    checkSameAsGeneral(mesh);
  }
}

TEST_CASE("A bubble beside a sheet with one curve is a sheet of its own", "[stages][partedCell]") {
  const Mesh mesh = shapes::merged({largeTriangle(1.5), shapes::octahedron({1.5, 1.5, 1.75}, 0.125)});
  const StagedCut cut(mesh, Stage::gridFaces);
  CHECK_FALSE(isParted(cut, {3, 3, 3}));
  CHECK(partedCells(cut) == 8);
  checkSameAsGeneral(mesh);
}

TEST_CASE("Triangles far inside of a cell belong to the sheet that leaves it, and those of a bubble do not", "[stages][partedCell]") {
  const Mesh dense = shapes::icosphere({1.52, 1.47, 1.55}, 1.2, 5);
  CHECK(partedCells(dense) == 26);
  const Mesh mesh = shapes::merged({dense, shapes::icosphere({1.52, 1.47, 1.55}, 0.3, 4), shapes::icosphere({1.5, 1.5, 0.6}, 0.1, 3)});
  const StagedCut cut(mesh, Stage::gridFaces);
  CHECK(cut.stencil.cells.size() == 27);
  CHECK(partedCells(cut) == 25);  // not the one around the first bubble, and not the one with the second
  checkSameAsGeneral(mesh);
}

TEST_CASE("A rim parts no cell that has a whole edge of it, but those that its triangles reach into", "[stages][partedCell]") {
  Mesh fan;  // around a hole inside of a cell, closed elsewhere outside of the grid
  fan.positions = {-5, -4, 1.5, 9, -3, 1.5, 1, 12, 1.5, 1.4, 1.4, 1.5, 1.6, 1.4, 1.6, 1.5, 1.6, 1.5};
  fan.triangles = {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 2, 0, 5, 0, 3, 5};
  const StagedCut cut(fan, Stage::gridFaces);
  CHECK_FALSE(isParted(cut, {3, 3, 3}));
  CHECK(partedCells(cut) == cut.stencil.cells.size() - 1);
  checkSameAsGeneral(fan);
}

TEST_CASE("Triangles that disagree about their sides part no cell", "[stages][partedCell]") {
  Mesh sheet = shapes::quad({-1, -1.1, 1.5}, {4, -1, 1.5}, {4.2, 4, 1.5}, {-1, 4.4, 1.5});
  CHECK(partedCells(sheet) > 0);
  std::swap(sheet.triangles[0], sheet.triangles[1]);
  CHECK(partedCells(sheet) == 0);
  checkSameAsGeneral(sheet);
}

TEST_CASE("A sheet with a vertex in a special position parts no cell beside that", "[stages][partedCell]") {
  const auto tent = [](const Point& top) {
    return shapes::merged({shapes::triangle({-9, -8, 1.3}, {9, -8.5, 1.3}, top), shapes::triangle({9, -8.5, 1.3}, {0, 13, 1.4}, top),
                           shapes::triangle({0, 13, 1.4}, {-9, -8, 1.3}, top)});
  };
  const size_t all = partedCells(tent({1.45, 1.55, 1.6}));
  CHECK(all == 9);
  CHECK(partedCells(tent({2, 1.55, 1.6})) == all - 2);   // a tri-vertex on a grid-face
  CHECK(partedCells(tent({2, 1, 1.6})) == all - 4);      // and on a grid-edge
  CHECK(partedCells(tent({1.45, 1.45, 2})) <= all - 1);  // and on one above
  const Mesh diagonal = shapes::quad({-1, -1, 1.5}, {4, -1, 1.5}, {4, 4, 1.5}, {-1, 4, 1.5});
  CHECK(partedCells(diagonal) == 2);  // a tri-edge crosses four grid-edges
  const Mesh upright = shapes::triangle({-5, -5, -7}, {9, 9, -7}, {2.5, 2.5, 19});
  CHECK(partedCells(upright) == 0);  // grid lines lie in the triangle
  for (const Mesh& mesh : {tent({2, 1.55, 1.6}), tent({2, 1, 1.6}), tent({1.45, 1.45, 2}), diagonal, upright}) checkSameAsGeneral(mesh);
}

TEST_CASE("A ridge that touches a grid-face from its other side is not taken for the sheet's", "[stages][partedCell]") {
  // In the plane z = 1, and bent: so it cuts off a piece of the grid-face that has none of its corners.
  Mesh ridge;
  ridge.positions = {1.75, 1, 1, 1.5, 1.5, 1, 1.25, 1, 1, 1.6, 1.2, 0.5, 1.8, 1.6, 0.5, 1.4, 1.2, 0.5, 1.2, 1.6, 0.5};
  ridge.triangles = {0, 1, 3, 1, 0, 4, 1, 2, 5, 2, 1, 6};
  for (const Mesh& sheet : {largeTriangle(1.5), shapes::flipped(largeTriangle(1.5))}) {
    const Mesh mesh = shapes::merged({ridge, sheet});
    CHECK_FALSE(isParted(StagedCut(mesh, Stage::gridFaces, unresolved()), {3, 3, 3}));
    checkSameAsGeneral(mesh);
  }
}

TEST_CASE("A side with many stitched vertices is special", "[stages][partedCell]") {
  constexpr uint32_t kStitched = 70;
  Mesh mesh = shapes::triangle({1.25, 1.25, 1.5}, {1.75, 1.25, 1.5}, {1.5, 1.75, 1.5});
  for (uint32_t i = 0; i < kStitched; ++i) {  // and a fan of triangles without area along the first side
    mesh.positions.insert(mesh.positions.end(), {1.25 + (i + 1) / 256.0, 1.25, 1.5});
    mesh.triangles.insert(mesh.triangles.end(), {0, 3 + i, i + 1 < kStitched ? 4 + i : 1});
  }
  CHECK(partedCells(mesh) == 0);
  checkSameAsGeneral(mesh);
}

TEST_CASE("A triangle turned the other way in a hole of a sheet, whose sides meet where triangles do, parts no cell",
          "[stages][partedCell]") {
  Mesh mesh;
  mesh.positions = {-5,  -4,  1.5,  9,   -3,  1.5,  1,   12,    1.5, 1.25, 1.25,  1.5, 1.75, 1.25,
                    1.5, 1.5, 1.75, 1.5, 1.5, 1.25, 1.5, 1.625, 1.5, 1.5,  1.375, 1.5, 1.5};
  mesh.triangles = {0, 1, 3, 1, 4, 6, 1, 6, 3, 1, 2, 4, 2, 5, 7, 2, 7, 4, 2, 0, 5, 0, 3, 8, 0, 8, 5, 3, 5, 4};
  checkSameAsGeneral(mesh, {});
}
