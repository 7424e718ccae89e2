// Each single broken invariant of the surface, the stencil, regions and winding numbers is found by the check named for it, at the
// element.
#include "catch.h"
#include "sketches.h"

using namespace mandoline;
using namespace sketches;

TEST_CASE("validate: nested bubbles", "[validate]") {
  Bubbles b;
  b.tetrahedron(0.125, 0.125, 0.125, 0.75);
  const std::vector<uint32_t> outerInward = b.inward, outerOutward = b.outward;
  b.tetrahedron(0.25, 0.25, 0.25, 0.125);
  const std::vector<uint32_t> innerInward(b.inward.begin() + 4, b.inward.end()), innerOutward(b.outward.begin() + 4, b.outward.end());
  SECTION("right") {
    b.cell({0, 0, 0}, 0, joined(b.boxSides, outerInward));
    b.cell({0, 0, 0}, 1, joined(outerOutward, innerInward));
    b.cell({0, 0, 0}, 2, innerOutward);
    b.setWinding({0, 1, 2});
    requirePass(b.validated());
  }
  SECTION("the inner one in the wrong cell") {
    b.cell({0, 0, 0}, 0, joined(joined(b.boxSides, outerInward), innerInward));
    b.cell({0, 0, 0}, 1, outerOutward);
    b.cell({0, 0, 0}, 2, innerOutward);
    b.setWinding({0, 1, 1});
    const Validation validation = b.validated();
    requireOnly(validation, {"partition"});
    CHECK(checkNamed(validation, "partition").elementKind == "cell");
  }
}

TEST_CASE("validate: surface", "[validate]") {
  SECTION("a face that names another triangle") {
    Halves h;
    h.cut.faceTriangle[h.triFaces[3]] = 0;
    h.cut.faceParents[h.cut.faceParentOffsets[h.triFaces[3]]] = 0;
    const Check check = checkNamed(h.validated(), "surfaceArea");
    CHECK_FALSE(check.pass);
    CHECK(check.elementKind == "triangle");
    CHECK(check.element <= 1);
    CHECK_FALSE(checkNamed(h.validated(), "planarity").pass);
  }
  SECTION("a triangle that occurs again, turned over") {
    Halves h;
    h.mesh.triangles.insert(h.mesh.triangles.end(), {0, 2, 1});
    h.cut.triangleCount = 3;
    requireFailure(h.validated(), "surfaceArea", "triangle", 2);
    requireFailure(h.validated(), "droppedTriangles", "triangle", 2);
    h.cut.droppedTriangles = {2};
    requireFailure(h.validated(), "droppedTriangles", "triangle", 2);
    h.cut.droppedTriangles.clear();
    h.addParent(h.triFaces[0], 2, -1);
    requireFailure(h.validated(), "surfaceArea", "triangle", 2);
    h.addParent(h.triFaces[2], 2, -1);
    requirePass(h.validated());
    h.cut.faceParentSigns[h.cut.faceParentOffsets[h.triFaces[0]] + 1] = 1;
    requireFailure(h.validated(), "faces", "face", h.triFaces[0]);
  }
  SECTION("a parent in another plane") {
    Bubbles b = bubble();
    const uint32_t face = b.outward[0] / 2;
    b.addParent(face, 3, 1);
    requireFailure(b.validated(), "faces", "face", face);
    requireFailure(b.validated(), "planarity", "face", face);
  }
  SECTION("dropped for a reason") {
    Bubbles b = bubble();
    b.mesh.positions.insert(b.mesh.positions.end(), {5, 5, 5, 6, 5, 5, 5, 6, 5});
    b.mesh.triangles.insert(b.mesh.triangles.end(), {4, 5, 6, 6, 5, 4, 0, 0, 1});  // outside, outside again, no area
    b.cut.triangleCount += 3;
    b.cut.droppedTriangles = {4, 5, 6};
    requirePass(b.validated());
    b.cut.droppedTriangles = {0, 4, 5, 6};
    requireFailure(b.validated(), "droppedTriangles", "triangle", 0);
  }
}

TEST_CASE("validate: stencil and regions", "[validate]") {
  SECTION("a grid cell that is nowhere") {
    Bubbles b = bubble();
    b.cut.runBegin.clear(), b.cut.runEnd.clear(), b.cut.runRegion.clear();
    b.finishRow();
    requireFailure(b.validated(), "stencil", "grid", 0);
  }
  SECTION("a grid cell both cut and untouched") {
    Bubbles b = bubble();
    b.cut.runBegin[0] = 0;
    requireFailure(b.validated(), "stencil", "cell", 0);
  }
  SECTION("a grid cell cut for nothing") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cut.runBegin.clear(), b.cut.runEnd.clear(), b.cut.runRegion.clear();
    b.finishRow();
    std::vector<uint32_t> other = b.box(1, b.boxSides[1] / 2);
    b.cell({0, 0, 0}, 0, joined(b.boxSides, b.inward));
    b.cell({0, 0, 0}, 1, b.outward);
    const uint32_t second = b.cell({1, 0, 0}, 0, other);
    b.setWinding({0, 1});
    requireFailure(b.validated(), "stencil", "cell", second);
    requireOnly(b.validated(), {"stencil"});
  }
  SECTION("a region in two parts") {
    Halves h;
    h.cut.cellRegion = {0, 0, 0, 0};
    h.cut.regionCount = 1;
    requireFailure(h.validated(), "regions", "cell", h.above[0]);
  }
  SECTION("a part in two regions") {
    Bubbles b = bubble();
    b.cut.runRegion[0] = 1;
    requireFailure(b.validated(), "regions", "run", 0);
  }
  SECTION("an empty region") {
    Bubbles b = bubble();
    b.cut.regionCount = 3;
    b.cut.regionWinding.push_back(0);
    requireFailure(b.validated(), "regions", "region", 2);
  }
}

TEST_CASE("validate: winding numbers", "[validate]") {
  SECTION("a step that is wrong") {
    Bubbles b = bubble();
    b.cut.regionWinding = {0, 2};
    requireFailure(b.validated(), "windingNumber", "face", b.outward[0] / 2);
    requireFailure(b.validated(), "inputVolume", "mesh", 0);
  }
  SECTION("right steps from a wrong start") {
    Bubbles b = bubble();
    b.cut.regionWinding = {1, 2};
    requireFailure(b.validated(), "inputVolume", "mesh", 0);
    CHECK_FALSE(checkNamed(b.validated(), "windingNumber").pass);
  }
  SECTION("missing") {
    Bubbles b = bubble();
    b.cut.hasWinding = false;
    b.cut.regionWinding.clear();
    requireFailure(b.validated(), "windingNumber", "mesh", 0);
  }
  SECTION("of an open input") {
    Halves h;
    h.cut.hasWinding = true;
    h.cut.regionWinding = {0, -1};
    requireFailure(h.validated(), "windingNumber", "mesh", 0);
  }
  SECTION("a triangle without area makes the input neither surely open nor surely closed") {
    Bubbles b = bubble();
    b.mesh.positions.insert(b.mesh.positions.end(), {5, 5, 5, 6, 6, 6, 7, 7, 7});
    b.mesh.triangles.insert(b.mesh.triangles.end(), {4, 5, 6});
    b.cut.triangleCount++;
    b.cut.droppedTriangles = {4};
    requirePass(b.validated());
    b.cut.hasWinding = false;
    b.cut.regionWinding.clear();
    requirePass(b.validated());
  }
  SECTION("all copies count") {
    for (const bool turned : {false, true}) {
      Bubbles b = bubble();
      for (uint32_t t = 0; t < 4; ++t) {
        const uint32_t *v = &b.mesh.triangles[3 * t], first = v[0], second = v[turned ? 2 : 1], third = v[turned ? 1 : 2];
        b.mesh.triangles.insert(b.mesh.triangles.end(), {first, second, third});
        b.addParent(b.outward[t] / 2, t + 4, turned ? -1 : 1);
      }
      b.cut.triangleCount = 8;
      b.cut.regionWinding = {0, turned ? 0 : 2};
      requirePass(b.validated());
      b.cut.regionWinding = {0, 1};
      requireFailure(b.validated(), "windingNumber", "face", b.outward[0] / 2);
      requireFailure(b.validated(), "inputVolume", "mesh", 0);
    }
  }
}
