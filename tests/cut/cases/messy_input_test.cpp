// Input that is turned, copied, unwelded, without area or near to planes, each with numbers known beforehand.
#include <algorithm>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

namespace {

/// The parents of the first face of triangle t, those with the opposite normal negated.
std::vector<int32_t> parentsOf(const CutMesh& mesh, int32_t t) {
  const size_t face = size_t(std::find(mesh.faceTriangle.begin(), mesh.faceTriangle.end(), t) - mesh.faceTriangle.begin());
  REQUIRE(face < mesh.faceCount());
  std::vector<int32_t> parents;
  for (uint32_t i = mesh.faceParentOffsets[face]; i < mesh.faceParentOffsets[face + 1]; ++i)
    parents.push_back(int32_t(mesh.faceParents[i]) * mesh.faceParentSigns[i]);
  return parents;
}

}  // namespace

TEST_CASE("inside-out and inconsistently oriented meshes", "[cases]") {
  const CheckedCut insideOut = checkedCut(flipped(icosphere({2, 2, 2}, 1.3, 2)), unitGrid(4));
  CHECK(insideOut.windingVolume(-1) == Approx(signedVolume(icosphere({2, 2, 2}, 1.3, 2))).epsilon(1e-12));
  for (const Mesh& good : {cube(1, 3), cube(0.5, 2.5), icosphere({2, 2, 2}, 1.3, 2)}) {
    Mesh mesh = good;
    for (size_t t = 0; t < mesh.triangleCount(); t += 3) std::swap(mesh.triangles[3 * t], mesh.triangles[3 * t + 1]);
    const CheckedCut expected = checkedCut(good, unitGrid(4));
    atBothOrientations(mesh, unitGrid(4), [&](const CheckedCut& cut, int) {
      CHECK_FALSE(cut.mesh.hasWinding);
      CHECK(cut.mesh.regionWinding.empty());
      CHECK(cut.cells() == expected.cells());
      CHECK(near(cut.regionVolumes(), expected.regionVolumes()));
    });
  }
}

TEST_CASE("welded and unwelded input", "[cases]") {
  for (const Mesh& mesh : {cube(1, 3), cube(0.5, 2.5), icosphere({2, 2, 2}, 1.3, 2), horizontalQuad(0.5, 2.5, 1.5)}) {
    const CheckedCut expected = checkedCut(mesh, unitGrid(4));
    atBothOrientations(unwelded(mesh), unitGrid(4), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == expected.cells());
      CHECK(cut.mesh.vertexCount() == expected.mesh.vertexCount());
      CHECK(cut.mesh.hasWinding == expected.mesh.hasWinding);
      CHECK(near(cut.regionVolumes(), expected.regionVolumes()));
      CHECK(cut.stats.weldedVertices == 3 * mesh.triangleCount() - mesh.vertexCount());
    });
  }
  SECTION("the two zeros are one") {
    const Mesh mesh = quad({-0.0, 1.5, 0}, {2, 1.5, 0}, {2, 1.5, 2}, {0.0, 1.5, 2});
    Mesh apart = unwelded(mesh);
    apart.positions[2] = -0.0;
    CHECK(checkedCut(apart, unitGrid(3)).stats.weldedVertices == 2);
  }
}

TEST_CASE("unreferenced vertices", "[cases]") {
  Mesh mesh = merged({triangle({7, 7, 7}, {1.5, 1.5, 1.5}, {1, 1, 1}), cube(0.5, 2.5), triangle({2.5, 2.5, 2.5}, {0, 0, 0}, {-9, 0, 0})});
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 3);
  mesh.triangles.resize(3 * 12);
  const CheckedCut expected = checkedCut(cube(0.5, 2.5), unitGrid(4));
  atBothOrientations(mesh, unitGrid(4), [&](const CheckedCut& cut, int) {
    CHECK(cut.cells() == expected.cells());
    CHECK(cut.mesh.vertexCount() == expected.mesh.vertexCount());
    CHECK(near(cut.regionVolumes(), expected.regionVolumes(), 0));
  });
}

TEST_CASE("zero-area triangles are dropped and reported", "[cases]") {
  SECTION("beside a good mesh") {
    Mesh mesh = cube(0.5, 2.5);
    const uint32_t first = uint32_t(mesh.triangleCount());
    mesh.triangles.insert(mesh.triangles.end(), {0, 0, 1, 5, 5, 5});         // repeated vertices
    mesh = merged({mesh, triangle({1, 1, 1}, {2, 2, 2}, {1.5, 1.5, 1.5})});  // collinear
    mesh = merged({mesh, triangle({1, 1, 1}, {2, 2, 2}, {1, 1, 1})});        // two at one position
    atBothOrientations(mesh, unitGrid(4), [&](const CheckedCut& cut, int) {
      CHECK(near(cut.regionVolumes(), {8, 56}));
      CHECK(cut.mesh.droppedTriangles == std::vector<uint32_t>{first, first + 1, first + 2, first + 3});
      CHECK(cut.stats.zeroAreaTriangles == 4);
    });
  }
  SECTION("their neighbours stay connected") {
    // One edge of the box has a middle vertex on one of its two sides only; a triangle without area joins the sides.
    for (double lo : {0.5, 1.}) {
      Mesh mesh = cube(lo, lo + 2);
      const size_t t = 8;  // 0 2 3: split its edge 2 3
      REQUIRE(mesh.triangles[3 * t + 1] == 2);
      REQUIRE(mesh.triangles[3 * t + 2] == 3);
      const uint32_t middle = uint32_t(mesh.vertexCount());
      mesh.positions.insert(mesh.positions.end(), {lo + 1, lo + 2, lo});
      mesh.triangles[3 * t + 2] = middle;  // 0 2 m
      mesh.triangles.insert(mesh.triangles.end(), {0, middle, 3, 2, 3, middle});
      atBothOrientations(mesh, unitGrid(4), [&](const CheckedCut& cut, int orientation) {
        CHECK(near(cut.regionVolumes(), {8, 56}));
        CHECK(cut.windingVolume(orientation) == Approx(8).epsilon(1e-12));
        CHECK(cut.mesh.droppedTriangles == std::vector<uint32_t>{13});
      });
    }
  }
  SECTION("a row of them on one edge") {
    // Two triangles of a sheet meet in an edge that one of them sees as three edges, joined by two triangles without area.
    Mesh mesh;
    mesh.positions = {0.5, 1.5, 0.5, 3.5, 1.5, 0.5, 2, 1.5, 3.5, 2, 3.5, 0.5, 1.25, 1.5, 0.5, 2.75, 1.5, 0.5};
    mesh.triangles = {0, 1, 2, 0, 3, 4, 4, 3, 5, 5, 3, 1, 0, 4, 1, 4, 5, 1};
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.mesh.regionCount == 1);
      CHECK(cut.mesh.droppedTriangles == std::vector<uint32_t>{4, 5});
    });
  }
  SECTION("nothing else") {
    const Mesh mesh = triangle({1, 1, 1}, {1.5, 1.5, 1.5}, {2, 2, 2});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(UntouchedCells(cut.mesh).count() == 27);
      CHECK(cut.mesh.droppedTriangles == std::vector<uint32_t>{0});
    });
  }
}

TEST_CASE("copies of triangles share their faces and are reported", "[cases]") {
  for (double lo : {0.5, 1.}) {
    Mesh mesh = cube(lo, lo + 2);
    const auto same = [&](size_t t, int turn, bool flip) {
      std::array<uint32_t, 3> corners;
      for (int k = 0; k < 3; ++k) corners[k] = mesh.triangles[3 * t + (k + turn) % 3];
      if (flip) std::swap(corners[0], corners[1]);
      mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
    };
    same(3, 1, false);
    same(7, 0, true);
    same(7, 2, false);
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(near(cut.regionVolumes(), {8, 56}));
      CHECK(cut.mesh.droppedTriangles.empty());
      CHECK(parentsOf(cut.mesh, 3) == std::vector<int32_t>{3, 12});
      CHECK(parentsOf(cut.mesh, 7) == std::vector<int32_t>{7, -13, 14});
      CHECK_FALSE(cut.mesh.hasWinding);
      CHECK(cut.stats.duplicateTriangles == 3);
    });
  }
  SECTION("a sheet with two sides") {
    const Mesh sheet = horizontalQuad(0.5, 2.5, 1.5);
    atBothOrientations(merged({sheet, flipped(sheet)}), unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 1);
      CHECK(cut.mesh.regionCount == 1);
      CHECK(cut.mesh.droppedTriangles.empty());
      CHECK(parentsOf(cut.mesh, 0) == std::vector<int32_t>{0, -2});
      CHECK(cut.windingVolume(0) == Approx(27).epsilon(1e-12));
    });
  }
}

TEST_CASE("snapTolerance moves vertices onto planes that near", "[cases]") {
  const double off = 1e-9;
  CutOptions options;
  options.snapTolerance = 1e-6;
  const CheckedCut snapped = checkedCut(cube(1 + off, 3 - off), unitGrid(4), options);
  CHECK(near(snapped.regionVolumes(), {8, 56}));
  CHECK(snapped.cells() == 64);
  CHECK(snapped.stats.snappedVertices == 8);
  CHECK(snapped.stats.largestSnap >= 0.9 * off);
  CHECK(snapped.stats.largestSnap <= 2 * off);
  const CheckedCut left = checkedCut(cube(1 - off, 3 + off), unitGrid(4));
  CHECK(left.stats.snappedVertices == 0);
  CHECK(left.cells() == 64 + 56);  // slivers
}
