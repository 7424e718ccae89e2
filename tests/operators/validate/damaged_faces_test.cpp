// Each single broken invariant of vertices, faces and shells is found by the check named for it, at the element.
#include <algorithm>

#include "catch.h"
#include "sketches.h"

using namespace mandoline;
using namespace sketches;

TEST_CASE("validate: vertices", "[validate]") {
  SECTION("a mask without one of its planes") {
    Halves h;
    const uint32_t v = h.vertex({0, 0, 0.5});
    h.cut.vertexMask[v] &= ~1;
    requireFailure(h.validated(), "vertices", "vertex", v);
  }
  SECTION("not the lowest of a welded group") {
    Halves h;
    h.mesh.positions.insert(h.mesh.positions.end(), {0, 0, 0.5});  // tri-vertex 0 once more
    h.mesh.triangles[3] = 4;
    requirePass(h.validated());
    const uint32_t v = h.vertex({0, 0, 0.5});
    h.cut.vertexTriVertex[v] = h.cut.vertexParents[2 * v] = h.cut.vertexParents[2 * v + 1] = 4;
    requireFailure(h.validated(), "vertices", "vertex", v);
  }
  SECTION("a tri-vertex that no triangle has") {
    Halves h;
    h.mesh.positions.insert(h.mesh.positions.end(), {0, 0, 0.5});  // tri-vertex 0 once more
    const uint32_t v = h.vertex({0, 0, 0.5});
    h.cut.vertexTriVertex[v] = h.cut.vertexParents[2 * v] = h.cut.vertexParents[2 * v + 1] = 4;
    requireFailure(h.validated(), "vertices", "vertex", v);
  }
  SECTION("an input vertex that is missing") {
    Bubbles b = bubble();
    b.mesh.positions.insert(b.mesh.positions.end(), {0.5, 0.5, 0.75});
    b.mesh.triangles.insert(b.mesh.triangles.end(), {0, 1, 4});
    b.cut.triangleCount++;
    requireFailure(b.validated(), "vertices", "tri-vertex", 4);
  }
  SECTION("a tri-vertex moved") {
    Bubbles b = bubble();
    const uint32_t v = b.vertex({0.75, 0.25, 0.25});
    b.cut.positions[3 * v] = std::nextafter(0.75, 1);
    requireFailure(b.validated(), "vertices", "vertex", v);
  }
  SECTION("a made vertex off its plane") {
    Halves h;
    const uint32_t v = h.vertex({1, 0.5, 0.5});
    h.cut.positions[3 * v] += 1e-12;
    requireFailure(h.validated(), "positions", "vertex", v);
  }
  SECTION("a made vertex off its tri-edge") {
    Halves h;
    const uint32_t v = h.vertex({1, 0.5, 0.5});
    h.cut.positions[3 * v + 1] += 1e-12;
    requireFailure(h.validated(), "positions", "vertex", v);
    h.cut.positions[3 * v + 1] = std::nextafter(0.5, 1);  // one rounding is fine
    requirePass(h.validated());
  }
}

TEST_CASE("validate: faces", "[validate]") {
  SECTION("in another plane than it names") {
    Halves h;
    h.cut.facePlane[h.middleBelow] = 2;
    requireFailure(h.validated(), "faces", "face", h.middleBelow);
  }
  SECTION("of a dropped triangle") {
    Bubbles b = bubble();
    b.cut.droppedTriangles = {0};
    requireFailure(b.validated(), "faces", "face", b.outward[0] / 2);
  }
  SECTION("off its triangle's plane") {
    Halves h;
    const uint32_t v = h.vertex({1, 0, 0.5});
    h.cut.positions[3 * v + 2] += 1e-12;
    requireFailure(h.validated(), "planarity", "face", h.triFaces[0]);
  }
  SECTION("outer loop the wrong way round") {
    Bubbles b = bubble();
    std::swap(b.cut.loopVertices[b.cut.loopOffsets[6]], b.cut.loopVertices[b.cut.loopOffsets[6] + 1]);
    requireFailure(b.validated(), "orientation", "face", 6);
  }
  SECTION("in two grid cells") {
    Halves h;
    std::swap(h.cut.loopVertices[0], h.cut.loopVertices[h.cut.loopOffsets[2] + 1]);  // (0, 0) of the left, (2, 0) of the right
    requireFailure(h.validated(), "gridCellIsolation", "face", h.triFaces[2]);
  }
}

TEST_CASE("validate: half-faces", "[validate]") {
  SECTION("cut-cell in another grid cell than its faces") {
    Halves h;
    h.cut.cellGridCell[3 * h.below[0]] = 1;
    requireFailure(h.validated(), "gridCellIsolation", "cell", h.below[0]);
  }
  SECTION("tri-face with one side only") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cell({0, 0, 0}, 0, joined(b.boxSides, std::vector<uint32_t>(b.inward.begin() + 1, b.inward.end())));
    b.cell({0, 0, 0}, 1, b.outward);
    b.setWinding({0, 1});
    requireFailure(b.validated(), "halfFaces", "face", b.inward[0] / 2);
    requireFailure(b.validated(), "closedCells", "cell", 0);
  }
  SECTION("listed twice") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cell({0, 0, 0}, 0, joined(b.boxSides, b.inward));
    b.cell({0, 0, 0}, 1, joined(b.outward, {b.outward[2]}));
    b.setWinding({0, 1});
    requireFailure(b.validated(), "halfFaces", "face", b.outward[2] / 2);
  }
  SECTION("owner on the other side of the plane") {
    Halves h;
    uint32_t& inMiddle = h.cut.cellHalfFaces[h.cut.cellHalfFaceOffsets[h.below[0]] + 3];
    REQUIRE(inMiddle == 2 * h.middleBelow);
    ++inMiddle;
    requireFailure(h.validated(), "halfFaces", "face", h.middleBelow);
  }
  SECTION("part of a grid-face towards an untouched grid cell") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    std::vector<uint32_t> sides = b.boxSides;
    const uint32_t whole = sides[1] / 2, l = b.cut.faceLoopOffsets[whole];
    const uint32_t rest = b.piece(0, 1, {{1, 0, 0}, {1, 1, 1}, {1, 0, 1}});
    b.cut.loopVertices[b.cut.loopOffsets[l] + 3] = b.vertex({1, 1, 1});
    // The loop of the first piece becomes a triangle: its last vertex goes.
    b.cut.loopVertices.erase(b.cut.loopVertices.begin() + b.cut.loopOffsets[l] + 3);
    for (size_t i = l + 1; i < b.cut.loopOffsets.size(); ++i) --b.cut.loopOffsets[i];
    b.cell({0, 0, 0}, 0, joined(joined(sides, {2 * rest}), b.inward));
    b.cell({0, 0, 0}, 1, b.outward);
    b.setWinding({0, 1});
    requireFailure(b.validated(), "halfFaces", "face", whole);
    requireOnly(b.validated(), {"halfFaces"});
  }
  SECTION("slit towards an untouched grid cell") {
    Bubbles b = bubble();
    const uint32_t whole = b.boxSides[1] / 2, l = b.cut.faceLoopOffsets[whole];
    const uint32_t corner = b.cut.loopVertices[b.cut.loopOffsets[l]], tip = b.vertex({1, 0.5, 0});
    b.cut.loopVertices.insert(b.cut.loopVertices.begin() + b.cut.loopOffsets[l] + 1, {tip, corner});
    for (size_t i = l + 1; i < b.cut.loopOffsets.size(); ++i) b.cut.loopOffsets[i] += 2;
    requireFailure(b.validated(), "halfFaces", "face", whole);
  }
}

TEST_CASE("validate: cells that do not fit around an edge", "[validate]") {
  Halves h;
  // The two lower cut-cells trade their pieces of the plane between them for the upper ones' tri-faces.
  uint32_t& lower = h.cut.cellHalfFaces[h.cut.cellHalfFaceOffsets[h.below[0]]];
  uint32_t& upper = h.cut.cellHalfFaces[h.cut.cellHalfFaceOffsets[h.above[0]]];
  REQUIRE((lower ^ upper) == 1);
  std::swap(lower, upper);
  const Validation validation = h.validated();
  CHECK_FALSE(checkNamed(validation, "facingFaces").pass);
  CHECK(checkNamed(validation, "facingFaces").elementKind == "face");
  CHECK_FALSE(checkNamed(validation, "closedCells").pass);
}

TEST_CASE("validate: a vertex inside of an edge", "[validate]") {
  Halves h;
  // The upper piece of the plane between the grid cells goes straight past the middle vertex, whose position is exact.
  const uint32_t l = h.cut.faceLoopOffsets[h.middleAbove], v = h.vertex({1, 0.5, 0.5});
  const auto begin = h.cut.loopVertices.begin();
  h.cut.loopVertices.erase(std::find(begin + h.cut.loopOffsets[l], begin + h.cut.loopOffsets[l + 1], v));
  for (size_t i = l + 1; i < h.cut.loopOffsets.size(); ++i) --h.cut.loopOffsets[i];
  requireFailure(h.validated(), "conforming", "vertex", v);
  requireFailure(h.validated(), "closedCells", "cell", h.above[0]);
}

TEST_CASE("validate: shells", "[validate]") {
  SECTION("two cells in one") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cell({0, 0, 0}, 0, joined(joined(b.boxSides, b.inward), b.outward));
    b.cut.hasWinding = true;
    b.cut.regionWinding = {0};
    requireFailure(b.validated(), "connected", "cell", 0);
  }
  SECTION("the bubble twice, and the rest of the grid cell lost (paper, section 6)") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cell({0, 0, 0}, 0, b.inward);
    b.cell({0, 0, 0}, 1, b.outward);
    b.setWinding({0, 1});
    requireFailure(b.validated(), "distinctCells", "cell", 1);
    requireFailure(b.validated(), "connected", "cell", 0);
    requireFailure(b.validated(), "cellVolume", "cell", 0);
    requireFailure(b.validated(), "gridCellVolume", "cell", 0);
    requireFailure(b.validated(), "gridFaceArea", "cell", 0);
    requireFailure(b.validated(), "partition", "cell", 0);
  }
  SECTION("a piece of a grid-face that covers too much") {
    Halves h;
    const uint32_t v = h.vertex({1, 0, 0.5});
    h.cut.positions[3 * v + 2] = 0.5 + 1e-9;
    const Check check = checkNamed(h.validated(), "gridFaceArea");
    CHECK(check.pass);  // both pieces moved alike
    Shelf s(false);
    s.cut.positions[3 * s.vertex({0, 1, 0}) + 1] = 1 - 1e-9;
    requireFailure(s.validated(), "gridFaceArea", "face", 0);
  }
}
