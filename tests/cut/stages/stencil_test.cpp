#include "catch.h"
#include "staged_cut.h"

using namespace stages;

TEST_CASE("One touched grid cell has 6 grid-faces, 12 grid-edges and 8 grid vertices", "[stages][stencil]") {
  const StagedCut cut(shapes::triangle({1.25, 1.25, 1.25}, {1.75, 1.25, 1.5}, {1.25, 1.75, 1.5}), Stage::stencil);
  const Stencil& stencil = cut.stencil;
  REQUIRE(stencil.cells.size() == 1);
  CHECK(stencil.cells[{0}].element == Slab{3, 3, 3});
  CHECK(stencil.faces.size() == 6);
  CHECK(stencil.edgeCount == 12);
  CHECK(stencil.cornerCount == 8);
  CHECK(stencil.triFacesInCell[{0}].size() == 1);
}

TEST_CASE("Neighbours share what lies between them", "[stages][stencil]") {
  // In the grid-face between two cells: both are touched.
  const StagedCut cut(shapes::triangle({1.25, 1.25, 1}, {1.75, 1.25, 1}, {1.25, 1.75, 1}), Stage::stencil);
  const Stencil& stencil = cut.stencil;
  REQUIRE(stencil.cells.size() == 2);
  CHECK(stencil.faces.size() == 11);
  CHECK(stencil.edgeCount == 20);
  CHECK(stencil.cornerCount == 12);
  const GridFaceId shared = stencil.cells[{0}].faces[cellFace(2, 1)];
  CHECK(stencil.cells[{1}].faces[cellFace(2, 0)] == shared);
  CHECK(stencil.triFacesOnFace[shared].size() == 1);
  CHECK(stencil.edgesOnFace[shared].size() == 3);
}

TEST_CASE("The whole grid's elements are counted once each", "[stages][stencil]") {
  // A sphere through all outer cells, and a triangle in the middle one.
  const Mesh sphere = shapes::icosphere({1.5, 1.5, 1.5}, 1.25, 3);
  const Mesh middle = shapes::triangle({1.25, 1.25, 1.25}, {1.75, 1.25, 1.5}, {1.25, 1.75, 1.5});
  const StagedCut cut(shapes::merged({sphere, middle}), Stage::stencil);
  const Stencil& stencil = cut.stencil;
  if (stencil.cells.size() == 27) {
    CHECK(stencil.faces.size() == 108);
    CHECK(stencil.edgeCount == 144);
    CHECK(stencil.cornerCount == 64);
  } else {
    FAIL("the shapes should touch all 27 cells, but touch " << stencil.cells.size());
  }
}

TEST_CASE("Corners of a grid-face run counter-clockwise, each edge from one to the next", "[stages][stencil]") {
  const StagedCut cut(shapes::triangle({1.25, 1.25, 1.25}, {1.75, 1.25, 1.5}, {1.25, 1.75, 1.5}), Stage::gridEdges);
  const Stencil& stencil = cut.stencil;
  const CutVertices& vertices = cut.brick.vertices;
  for (const Stencil::Face& face : stencil.faces) {
    const auto& corners = stencil.cells[face.cell].corners;
    std::array<VertexId, 4> v;
    for (size_t i = 0; i < 4; ++i) v[i] = cut.gridEdges.corners[corners[kOutlines[face.index].corners[i]]];
    Predicates predicates;
    for (size_t i = 0; i < 4; ++i) CHECK(vertices.orient(v[i], v[(i + 1) % 4], v[(i + 2) % 4], face.axis(), predicates) > 0);
  }
}
