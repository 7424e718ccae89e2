#include <algorithm>

#include "catch.h"
#include "staged_cut.h"

using namespace stages;

namespace {

/// The pieces of the one grid-face that has more than one loop or piece, as loops per piece.
std::vector<size_t> loopsOfPieces(const StagedCut& cut, GridFaceId gridFace) {
  std::vector<size_t> counts;
  for (const HalfFace h : cut.state.faces.grid.halfFaces[gridFace]) counts.push_back(cut.state.faces.loops(h.face()).size());
  return counts;
}

/// The grid-face across z at plane 1 of the grid cells (1, 1, ...).
GridFaceId middleFace(const Stencil& stencil) {
  for (const GridCellId c : stencil.cells.ids()) {
    if (stencil.cells[c].element == Slab{3, 3, 1}) return stencil.cells[c].faces[cellFace(2, 1)];
  }
  FAIL("the grid cell is not in the stencil");
  return {};
}

}  // namespace

TEST_CASE("Grid-faces that nothing passes stay whole", "[stages][gridFaces]") {
  const StagedCut cut(shapes::octahedron({1.5, 1.5, 1.5}, 0.25), Stage::gridFaces);
  CHECK(cut.state.faces.grid.size() == 6);
  for (const GridFaceId g : cut.state.stencil.faces.ids()) {
    CHECK(loopsOfPieces(cut, g) == std::vector<size_t>{1});
    CHECK(cut.state.faces.loops(cut.state.faces.grid.halfFaces[g][0].face())[0].size() == 4);
  }
}

TEST_CASE("A tunnel leaves a face with a hole and a face in it", "[stages][gridFaces]") {
  const StagedCut cut(shapes::octahedron({1.5, 1.5, 1}, 0.25), Stage::gridFaces);
  std::vector<size_t> loops = loopsOfPieces(cut, middleFace(cut.state.stencil));
  std::sort(loops.begin(), loops.end());
  CHECK(loops == std::vector<size_t>{1, 2});
}

TEST_CASE("The end of a sheet leaves a slit", "[stages][gridFaces]") {
  const StagedCut cut(shapes::triangle({1.25, 1.5, 0.5}, {1.75, 1.5, 0.5}, {1.5, 1.5, 1.5}), Stage::gridFaces);
  const GridFaceId face = middleFace(cut.state.stencil);
  CHECK(loopsOfPieces(cut, face) == std::vector<size_t>{1});
  CHECK(cut.state.faces.grid.slits[face].size() == 1);
}

TEST_CASE("A triangle in a grid-face takes the place of that piece", "[stages][gridFaces]") {
  const StagedCut cut(shapes::triangle({1.25, 1.25, 1}, {1.75, 1.25, 1}, {1.25, 1.75, 1}), Stage::gridFaces);
  const GridFaceId face = middleFace(cut.state.stencil);
  const auto halfFaces = cut.state.faces.grid.halfFaces[face];
  REQUIRE(halfFaces.size() == 2);
  CHECK(cut.state.faces.isTri(halfFaces[0].face()));
  CHECK(cut.state.faces.triangle(halfFaces[0].face()) == TriangleId{0});
  CHECK(halfFaces[0].side() == 0);  // the normal is +z, out of the cell below
  CHECK_FALSE(cut.state.faces.isTri(halfFaces[1].face()));
  CHECK_FALSE(cut.state.faces.triangle(halfFaces[1].face()));
  CHECK(cut.state.faces.loops(halfFaces[1].face()).size() == 2);
}
