// Closed, open and non-manifold surfaces, each with numbers known beforehand and at both orientations of the triangles.
#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

namespace {

constexpr double big = 10;  // beyond all of these grids

/// Whether some cut-cell holds both sides of the face of triangle t.
bool holdsBothSides(const CutMesh& mesh, int32_t t) {
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    int sides[2] = {0, 0};
    for (uint32_t h : mesh.halfFaces(c))
      if (mesh.faceTriangle[h / 2] == t) ++sides[h % 2];
    if (sides[0] > 0 && sides[1] > 0) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("closed: sphere about a grid vertex", "[cases]") {
  // It reaches through the inner planes into 24 outer cells, but not as far as the grid's outer edges.
  const Mesh sphere = icosphere({2, 2, 2}, 1.3, 3);
  const double volume = signedVolume(sphere);
  atBothOrientations(sphere, unitGrid(4), [&](const CheckedCut& cut, int orientation) {
    CHECK(cut.cells() == 64 + 8 + 24);
    CHECK(near(cut.regionVolumes(), {volume, 64 - volume}));
    CHECK(cut.windingVolume(orientation) == Approx(volume).epsilon(1e-12));
    CHECK(cut.windingVolume(0) == Approx(64 - volume).epsilon(1e-12));
  });
}

TEST_CASE("closed: torus and noisy sphere", "[cases]") {
  for (const Mesh& mesh : {torus({2.1, 2.2, 2.3}, 1.25, 0.4, 24, 12), noisySphere({2, 2, 2}, 1.5, 0.2, 3)}) {
    const double volume = signedVolume(mesh);
    atBothOrientations(mesh, unitGrid(4), [&](const CheckedCut& cut, int orientation) {
      CHECK(near(cut.regionVolumes(), {volume, 64 - volume}));
      CHECK(cut.windingVolume(orientation) == Approx(volume).epsilon(1e-12));
    });
  }
}

TEST_CASE("closed: aligned cube of 2x2x2 cells", "[cases]") {
  atBothOrientations(cube(1, 3), unitGrid(4), [](const CheckedCut& cut, int orientation) {
    CHECK(cut.cells() == 64);
    CHECK(near(cut.regionVolumes(), {8, 56}, 0));
    CHECK(cut.windingVolume(orientation) == 8);
  });
}

TEST_CASE("closed: aligned cube of one cell", "[cases]") {
  atBothOrientations(cube(1, 2), unitGrid(4), [](const CheckedCut& cut, int orientation) {
    CHECK(cut.cells() == 64);
    CHECK(near(cut.regionVolumes(), {1, 63}, 0));
    CHECK(cut.windingVolume(orientation) == 1);
  });
}

TEST_CASE("open: partial cuts", "[cases]") {
  // The sheet crosses four cells wholly and ends in the twelve around them.
  atBothOrientations(horizontalQuad(0.5, 3.5, 1.5), unitGrid(4), [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 64 + 4);
    CHECK(cut.mesh.regionCount == 1);
    CHECK_FALSE(cut.mesh.hasWinding);
    CHECK(near(cut.volumesIn(1, 1, 1), {0.5, 0.5}));
    CHECK(near(cut.volumesIn(0, 1, 1), {1}));
    CHECK(near(cut.volumesIn(0, 0, 1), {1}));
  });
}

TEST_CASE("open: a sheet ending in a cell", "[cases]") {
  const Mesh sheetToX = quad({-big, -big, 1.5}, {1.5, -big, 1.5}, {1.5, big, 1.5}, {-big, big, 1.5});
  atBothOrientations(sheetToX, unitGrid(3), [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 27 + 3);
    CHECK(cut.mesh.regionCount == 1);
    for (int j = 0; j < 3; ++j) {
      CHECK(near(cut.volumesIn(0, j, 1), {0.5, 0.5}));
      CHECK(near(cut.volumesIn(1, j, 1), {1}));
    }
  });
}

TEST_CASE("open: a sheet ending on an axial plane", "[cases]") {
  const Mesh sheetToX = quad({-big, -big, 1.5}, {2, -big, 1.5}, {2, big, 1.5}, {-big, big, 1.5});
  atBothOrientations(sheetToX, unitGrid(3), [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 27 + 6);
    CHECK(cut.mesh.regionCount == 1);
    CHECK(near(cut.volumesIn(1, 1, 1), {0.5, 0.5}));
  });
}

TEST_CASE("open: a sheet floating wholly inside one cell", "[cases]") {
  atBothOrientations(horizontalQuad(1.25, 1.75, 1.5), unitGrid(4), [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 64);
    CHECK(cut.mesh.regionCount == 1);
    CHECK(near(cut.volumesIn(1, 1, 1), {1}));
    CHECK(holdsBothSides(cut.mesh, 0));
    CHECK(holdsBothSides(cut.mesh, 1));
  });
}

TEST_CASE("open: an open box inside one cell", "[cases]") {
  Mesh openBox = cube(1.25, 1.75);
  openBox.triangles.resize(3 * 10);  // without its top
  atBothOrientations(openBox, unitGrid(3), [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 27);
    CHECK(near(cut.volumesIn(1, 1, 1), {1}));
  });
}

TEST_CASE("open: Moebius strip", "[cases]") {
  for (int64_t n : {1, 4, 9}) {
    const Grid grid = Grid::box({0, 0, 0}, {4, 4, 4}, {n, n, n});
    atBothOrientations(moebius({2.1, 2.05, 1.95}, 1.25, 0.75, 40), grid, [](const CheckedCut& cut, int) {
      CHECK(cut.mesh.regionCount == 1);
      CHECK_FALSE(cut.mesh.hasWinding);
    });
  }
}

TEST_CASE("non-manifold: three and more sheets on an edge", "[cases]") {
  SECTION("three sheets divide the grid") {
    const Mesh mesh = fan({1.5, 1.5, -big}, 2 * big, {{big, 0}, {-big, 0}, {0, -big}});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(near(cut.regionVolumes(), {6.75, 6.75, 13.5}));
      CHECK(near(cut.volumesIn(1, 1, 1), {0.25, 0.25, 0.5}));
      CHECK(cut.cells() == 27 + 3 * (1 + 1 + 1 + 2));
    });
  }
  SECTION("five sheets divide the grid, two of them through grid lines") {
    const Mesh mesh = fan({1.5, 1.5, -big}, 2 * big, {{big, 0}, {big, big}, {-big, big}, {-big, 0}, {0, -big}});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(near(cut.regionVolumes(), {3.375, 3.375, 6.75, 6.75, 6.75}));
      CHECK(cut.volumesIn(1, 1, 1).size() == 5);
    });
  }
  SECTION("four sheets float in one cell") {
    const Mesh mesh = fan({1.5, 1.5, 1.25}, 0.5, {{0.25, 0}, {0, 0.25}, {-0.25, 0}, {0, -0.25}});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27);
      CHECK(near(cut.volumesIn(1, 1, 1), {1}));
    });
  }
  SECTION("four sheets on a grid line") {
    const Mesh mesh = fan({2, 2, 0.5}, 2, {{0.75, 0.25}, {-0.25, 0.75}, {-0.75, -0.25}, {0.25, -0.75}});
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) { CHECK(cut.cells() == 64); });
  }
  SECTION("two boxes that share an edge") {
    const Mesh mesh = merged({box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}), box({1.5, 1.5, 0.5}, {2.5, 2.5, 1.5})});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int orientation) {
      CHECK(near(cut.regionVolumes(), {1, 1, 25}));
      CHECK(cut.windingVolume(orientation) == Approx(2).epsilon(1e-12));
      CHECK(cut.volumesIn(1, 1, 0).size() == 3);
    });
  }
  SECTION("a box with a wall inside") {
    const Mesh wall = quad({1.5, 0.5, 0.5}, {1.5, 2.5, 0.5}, {1.5, 2.5, 2.5}, {1.5, 0.5, 2.5});
    Mesh mesh = merged({box({0.5, 0.5, 0.5}, {1.5, 2.5, 2.5}), box({1.5, 0.5, 0.5}, {2.5, 2.5, 2.5})});
    // The two boxes' sides at x = 1.5 are four triangles in two pairs of duplicates if their diagonals agree: make that the wall.
    Mesh sides;
    sides.positions = mesh.positions;
    for (size_t t = 0; t < mesh.triangleCount(); ++t) {
      bool inWall = true;
      for (int k = 0; k < 3; ++k) inWall = inWall && mesh.positions[3 * mesh.triangles[3 * t + k]] == 1.5;
      if (!inWall) sides.triangles.insert(sides.triangles.end(), &mesh.triangles[3 * t], &mesh.triangles[3 * t] + 3);
    }
    REQUIRE(sides.triangleCount() == 20);
    atBothOrientations(merged({sides, wall}), unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(near(cut.regionVolumes(), {4, 4, 19}));
      CHECK_FALSE(cut.mesh.hasWinding);
      CHECK(near(cut.volumesIn(1, 1, 1), {0.5, 0.5}));
    });
  }
}

TEST_CASE("non-manifold: bow-tie vertices", "[cases]") {
  SECTION("inside a cell") {
    const Mesh mesh = merged({octahedron({1.5, 1.5, 1}, 0.5), octahedron({1.5, 1.5, 2}, 0.5)});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 31);
      CHECK(near(cut.regionVolumes(), {1. / 6, 1. / 6, 27 - 1. / 3}));
      CHECK(cut.volumesIn(1, 1, 1).size() == 3);
    });
  }
  SECTION("at a grid vertex") {
    const Mesh mesh = merged({octahedron({1.5, 2, 2}, 0.5), octahedron({2.5, 2, 2}, 0.5)});
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 64 + 8);
      CHECK(near(cut.regionVolumes(), {1. / 6, 1. / 6, 64 - 1. / 3}));
    });
  }
  SECTION("open fans that meet in one vertex") {
    const Mesh mesh = merged({triangle({1.5, 1.5, 1.5}, {1.75, 1.5, 1.25}, {1.75, 1.75, 1.5}),
                              triangle({1.5, 1.5, 1.5}, {1.25, 1.5, 1.75}, {1.25, 1.25, 1.25}),
                              triangle({1.5, 1.5, 1.5}, {1.5, 1.75, 2.5}, {1.5, 1.5, 2.5})});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) { CHECK(cut.cells() == 27); });
  }
}
