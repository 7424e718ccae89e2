// Meshes in positions that are degenerate, and much larger or smaller than the grid and its cells, each with numbers known beforehand.
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

namespace {

constexpr double big = 10;  // beyond all of these grids

}  // namespace

TEST_CASE("coplanar triangles on axial planes with normals of both signs", "[cases]") {
  const std::pair<double, double> spans[] = {{1, 2}, {1.25, 1.75}, {0.5, 2.5}, {0, 4}, {-1, 5}, {1, 1.5}};
  for (const auto& [lo, hi] : spans) {
    const bool divides = lo <= 0 && hi >= 4;
    atBothOrientations(horizontalQuad(lo, hi, 2), unitGrid(4), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 64);
      CHECK(cut.volume() == 64);
      CHECK(cut.mesh.regionCount == (divides ? 2 : 1));
    });
  }
  SECTION("on the boundary of the grid") {
    for (double z : {0., 4.})
      atBothOrientations(horizontalQuad(0.5, 2.5, z), unitGrid(4), [](const CheckedCut& cut, int) { CHECK(cut.cells() == 64); });
  }
  SECTION("of both signs side by side") {
    const Mesh mesh = merged({quad({0.5, 0.5, 2}, {1.5, 0.5, 2}, {1.5, 1.5, 2}, {0.5, 1.5, 2}),
                              flipped(quad({1.5, 0.5, 2}, {2.5, 0.5, 2}, {2.5, 1.5, 2}, {1.5, 1.5, 2}))});
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) { CHECK(cut.cells() == 64); });
  }
  SECTION("with one side of a box off the planes") {
    atBothOrientations(box({1, 1, 1}, {2, 2, 1.5}), unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 28);
      CHECK(near(cut.volumesIn(1, 1, 1), {0.5, 0.5}));
    });
  }
  SECTION("terraces on three planes") {
    const Mesh mesh = prism({{0.5, 0.5}, {3.5, 0.5}, {3.5, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 3}, {0.5, 3}}, 1, 3);
    const double volume = signedVolume(mesh);
    atBothOrientations(mesh, unitGrid(4), [&](const CheckedCut& cut, int) { CHECK(near(cut.regionVolumes(), {volume, 64 - volume})); });
  }
}

TEST_CASE("vertices and edges exactly on planes, grid lines and grid vertices", "[cases]") {
  SECTION("vertices on grid vertices") {
    atBothOrientations(octahedron({2, 2, 2}, 1), unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 64 + 8);
      CHECK(near(cut.regionVolumes(), {4. / 3, 64 - 4. / 3}));
      CHECK(near(cut.volumesIn(1, 1, 1), {1. / 6, 5. / 6}));
    });
  }
  SECTION("vertices on grid lines") {
    atBothOrientations(octahedron({2, 2, 2}, 0.5), unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 64 + 8);
      CHECK(near(cut.volumesIn(1, 1, 1), {1. / 48, 47. / 48}));
    });
  }
  SECTION("an edge on a grid line") {
    const Mesh mesh = tetrahedron({1, 1, 0.5}, {1, 1, 2.5}, {1.75, 1.25, 1.5}, {1.25, 1.75, 1.5});
    const double volume = std::abs(signedVolume(mesh));
    atBothOrientations(mesh, unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 30);
      CHECK(near(cut.regionVolumes(), {volume, 27 - volume}));
    });
  }
  SECTION("an edge in an axial plane") {
    const Mesh mesh = tetrahedron({1, 0.5, 0.75}, {1, 2.5, 2.25}, {2.5, 1.25, 1.5}, {2.25, 1.75, 1.25});
    const double volume = std::abs(signedVolume(mesh));
    atBothOrientations(mesh, unitGrid(3), [&](const CheckedCut& cut, int) { CHECK(near(cut.regionVolumes(), {volume, 27 - volume})); });
  }
  SECTION("an open sheet that ends on a grid line and in grid vertices") {
    const Mesh mesh = quad({1, 1, 1}, {2, 1, 2}, {2, 3, 2}, {1, 3, 1});
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 66);
      CHECK(near(cut.volumesIn(1, 1, 1), {0.5, 0.5}));
      CHECK(cut.mesh.regionCount == 1);
    });
  }
  SECTION("a tetrahedron in four grid vertices") {
    atBothOrientations(tetrahedron({1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}), unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 28);
      CHECK(near(cut.volumesIn(1, 1, 1), {1. / 6, 5. / 6}));
    });
  }
}

TEST_CASE("edges through grid vertices", "[cases]") {
  SECTION("of a closed surface") {
    // |x| + |y| + |z| <= 2 about (2, 2, 2): its edges are diagonals of grid-faces.
    atBothOrientations(octahedron({2, 2, 2}, 2), unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 64 + 32);
      CHECK(near(cut.regionVolumes(), {32. / 3, 64 - 32. / 3}));
      CHECK(near(cut.volumesIn(1, 1, 1), {1. / 6, 5. / 6}));
      CHECK(near(cut.volumesIn(0, 1, 1), {1. / 6, 5. / 6}));
    });
  }
  SECTION("along the diagonal of the grid") {
    const Mesh mesh = triangle({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5}, {3.5, 0.5, 2});
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) { CHECK(cut.mesh.regionCount == 1); });
  }
  SECTION("of a sheet on either side") {
    const Mesh mesh = merged({triangle({0, 0, 0}, {3, 3, 3}, {3, 0, 1.5}), triangle({3, 3, 3}, {0, 0, 0}, {0, 3, 1.5})});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) { CHECK(cut.volumesIn(1, 1, 1).size() == 2); });
  }
}

TEST_CASE("triangles in diagonal planes that contain grid lines", "[cases]") {
  SECTION("a sheet in x = y") {
    const Mesh mesh = quad({-1, -1, -1}, {4, 4, -1}, {4, 4, 4}, {-1, -1, 4});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 9);
      CHECK(near(cut.regionVolumes(), {13.5, 13.5}));
      CHECK(near(cut.volumesIn(2, 2, 0), {0.5, 0.5}));
    });
  }
  SECTION("a sheet in x = y that ends in cells") {
    const Mesh mesh = quad({0.5, 0.5, 0.5}, {2.5, 2.5, 0.5}, {2.5, 2.5, 2.5}, {0.5, 0.5, 2.5});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 1);
      CHECK(near(cut.volumesIn(1, 1, 1), {0.5, 0.5}));
    });
  }
  SECTION("a triangle in x = y whose corner lies on a grid line") {
    const Mesh mesh = triangle({1, 1, 0.5}, {2.5, 2.5, 1.5}, {1, 1, 2.25});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) { CHECK(cut.mesh.regionCount == 1); });
  }
  SECTION("a prism with one side in x = y") {
    atBothOrientations(prism({{1, 1}, {3, 1}, {3, 3}}, 0.5, 2.5), unitGrid(4), [](const CheckedCut& cut, int orientation) {
      CHECK(cut.cells() == 64 + 8);
      CHECK(near(cut.regionVolumes(), {4, 60}));
      CHECK(cut.windingVolume(orientation) == Approx(4).epsilon(1e-12));
    });
  }
  SECTION("sheets in x = y, y = z and z = x about the diagonal") {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
      // Half of the plane where the other two coordinates agree, from the diagonal on.
      Point end = {-big, -big, -big}, otherEnd = {big, big, big}, side = {0, 0, 0};
      side[axis] = 40;
      Point a = end, b = otherEnd;
      for (int d = 0; d < 3; ++d) a[d] += side[d], b[d] += side[d];
      mesh = merged({mesh, quad(end, otherEnd, b, a)});
    }
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(near(cut.regionVolumes(), {9, 9, 9}));
      CHECK(near(cut.volumesIn(1, 1, 1), {1. / 3, 1. / 3, 1. / 3}));
    });
  }
}

TEST_CASE("triangles spanning many cells", "[cases]") {
  SECTION("a box of twelve") {
    atBothOrientations(cube(0.5, 15.5), unitGrid(16), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 16 * 16 * 16 + (16 * 16 * 16 - 14 * 14 * 14));
      CHECK(near(cut.regionVolumes(), {4096 - 3375, 3375}, 1e-9));
    });
  }
  SECTION("one far larger than the grid") {
    const Mesh mesh = triangle({100.5, -48, -48}, {-48, 100.5, -48}, {-48, -48, 100.5});  // in x + y + z = 4.5
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 19);
      CHECK(near(cut.regionVolumes(), {13.5, 13.5}));
    });
  }
  SECTION("a needle") {
    const Mesh mesh = tetrahedron({0.25, 0.3, 0.35}, {0.26, 0.3, 0.35}, {0.25, 0.31, 0.35}, {9.5, 9.25, 9.75});
    const double volume = signedVolume(mesh);
    atBothOrientations(mesh, unitGrid(10), [&](const CheckedCut& cut, int) {
      CHECK(near(cut.regionVolumes(), {volume, 1000 - volume}, 1e-9));
    });
  }
}

TEST_CASE("triangles far smaller than a cell", "[cases]") {
  for (double radius : {0.25, 1e-3, 1e-9}) {
    const Mesh sphere = icosphere({1.5, 1.5, 1.5}, radius, 4);
    const double volume = signedVolume(sphere);
    atBothOrientations(sphere, unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 28);
      REQUIRE(cut.volumesIn(1, 1, 1).size() == 2);
      CHECK(cut.volumesIn(1, 1, 1).front() == Approx(volume).epsilon(1e-9));
    });
  }
  SECTION("across a grid vertex") {
    const Mesh sphere = icosphere({2, 2, 2}, 1e-3, 3);
    const double volume = signedVolume(sphere);
    atBothOrientations(sphere, unitGrid(4), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 64 + 8);
      CHECK(cut.regionVolumes().front() == Approx(volume).epsilon(1e-9));
      CHECK(cut.volumesIn(1, 1, 1).front() == Approx(volume / 8).epsilon(1e-2));
    });
  }
}

TEST_CASE("mesh partly outside of the grid", "[cases]") {
  atBothOrientations(cube(2, 5), unitGrid(4), [](const CheckedCut& cut, int orientation) {
    CHECK(cut.cells() == 64);
    CHECK(near(cut.regionVolumes(), {8, 56}));
    CHECK(cut.windingVolume(orientation) == 8);
  });
  atBothOrientations(cube(2.5, 5), unitGrid(4), [](const CheckedCut& cut, int orientation) {
    CHECK(cut.cells() == 64 + 7);
    CHECK(near(cut.regionVolumes(), {3.375, 64 - 3.375}));
    CHECK(cut.windingVolume(orientation) == Approx(3.375).epsilon(1e-12));
  });
  atBothOrientations(icosphere({0, 0, 0}, 1.5, 3), unitGrid(3), [](const CheckedCut& cut, int) { CHECK(cut.mesh.regionCount == 2); });
}

TEST_CASE("mesh wholly outside of the grid", "[cases]") {
  for (const Mesh& mesh : {cube(5, 6), cube(-3, -1), icosphere({10, 2, 2}, 1, 2), horizontalQuad(0, 4, 7)})
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.mesh.cellCount() == 0);
      CHECK(UntouchedCells(cut.mesh).count() == 64);
      CHECK(cut.mesh.regionCount == 1);
      CHECK(cut.mesh.droppedTriangles.size() == cut.mesh.triangleCount);
    });
  SECTION("touching it") {
    for (const Mesh& mesh : {box({4, 1, 1}, {5, 2, 2}), octahedron({5, 2, 2}, 1), box({4, 4, 4}, {5, 5, 5})})
      atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) {
        CHECK(cut.cells() == 64);
        CHECK(cut.mesh.regionCount == 1);
      });
  }
  SECTION("all around it") {
    atBothOrientations(cube(-1, 5), unitGrid(4), [](const CheckedCut& cut, int orientation) {
      CHECK(UntouchedCells(cut.mesh).count() == 64);
      CHECK(cut.windingVolume(orientation) == 64);
    });
  }
}

TEST_CASE("mesh exactly as large as the grid", "[cases]") {
  atBothOrientations(cube(0, 4), unitGrid(4), [](const CheckedCut& cut, int orientation) {
    CHECK(cut.cells() == 64);
    CHECK(cut.mesh.regionCount == 1);
    CHECK(cut.windingVolume(orientation) == 64);
  });
  atBothOrientations(octahedron({2, 2, 2}, 2), Grid::box({0, 0, 0}, {4, 4, 4}, {1, 1, 1}), [](const CheckedCut& cut, int) {
    CHECK(near(cut.volumesIn(0, 0, 0), {32. / 3, 64 - 32. / 3}));
  });
}

TEST_CASE("1x1x1 grid", "[cases]") {
  atBothOrientations(cube(0.25, 0.75), unitGrid(1), [](const CheckedCut& cut, int orientation) {
    CHECK(cut.mesh.cellCount() == 2);
    CHECK(cut.cells() == 2);
    CHECK(near(cut.regionVolumes(), {0.125, 0.875}));
    CHECK(cut.windingVolume(orientation) == Approx(0.125).epsilon(1e-12));
  });
  atBothOrientations(icosphere({0.5, 0.5, 0.5}, 0.4, 3), unitGrid(1), [](const CheckedCut& cut, int) { CHECK(cut.cells() == 2); });
  atBothOrientations(cube(0, 1), unitGrid(1), [](const CheckedCut& cut, int) { CHECK(cut.cells() == 1); });
  atBothOrientations(horizontalQuad(-1, 2, 0.5), unitGrid(1), [](const CheckedCut& cut, int) {
    CHECK(near(cut.regionVolumes(), {0.5, 0.5}));
  });
}

TEST_CASE("spacing that differs by axis", "[cases]") {
  const Grid grid = Grid::regular({0.5, -1, 2}, {0.5, 2, 0.25}, {4, 3, 8});  // [0.5, 2.5] x [-1, 5] x [2, 4]
  REQUIRE(grid.uniform);
  REQUIRE(grid.planes[1] == std::vector<double>{-1, 1, 3, 5});
  atBothOrientations(box({1, 1, 2.5}, {2, 3, 3.5}), grid, [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 96);
    CHECK(near(cut.regionVolumes(), {2, 22}));
  });
  atBothOrientations(box({1.25, 0, 2.625}, {1.75, 4, 3.375}), grid, [](const CheckedCut& cut, int) {
    CHECK(near(cut.regionVolumes(), {1.5, 22.5}));
    CHECK(cut.cells() == 96 + 2 * 3 * 4);
  });
  const Mesh ellipsoid = translated(scaled(icosphere({0, 0, 0}, 1, 3), {0.75, 2.5, 0.875}), {1.5, 2, 3});
  const double volume = signedVolume(ellipsoid);
  atBothOrientations(ellipsoid, grid, [&](const CheckedCut& cut, int) { CHECK(near(cut.regionVolumes(), {volume, 24 - volume})); });
}

TEST_CASE("grid graded by its planes", "[cases]") {
  const Grid grid = Grid::rectilinear({{{0, 0.5, 2, 2.25, 4}, {0, 1, 1.125, 3, 4}, {0, 2, 2.5, 4}}});
  REQUIRE_FALSE(grid.uniform);
  atBothOrientations(box({0.5, 1, 2}, {2.25, 3, 2.5}), grid, [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 48);
    CHECK(near(cut.regionVolumes(), {1.75, 62.25}));
  });
  atBothOrientations(box({0.25, 0.5, 1}, {2.125, 1.0625, 2.25}), grid, [](const CheckedCut& cut, int) {
    const double volume = 1.875 * 0.5625 * 1.25;
    CHECK(cut.cells() == 48 + 12);
    CHECK(near(cut.regionVolumes(), {volume, 64 - volume}));
  });
  const Mesh sphere = icosphere({2, 1.75, 2.25}, 1.5, 3);
  const double volume = signedVolume(sphere);
  atBothOrientations(sphere, grid, [&](const CheckedCut& cut, int) { CHECK(near(cut.regionVolumes(), {volume, 64 - volume})); });
}

TEST_CASE("grids have the planes they promise", "[cases]") {
  const Grid tenths = Grid::box({0, 0, 0}, {1, 1, 1}, {10, 10, 10});
  CHECK(tenths.planes[0][3] == 0.3);
  CHECK(tenths.planes[2].front() == 0);
  CHECK(tenths.planes[2].back() == 1);
  CHECK(tenths.uniform);
  const Mesh slab = box({0, 0, 0}, {4, 2, 1});
  const Grid around = Grid::around(slab, 11);  // cells of size 0.4; the other sides are 2.2 and 1.1 with the margin
  CHECK(around.cells(0) == 11);
  const Grid wide = Grid::around(slab, 20, 2);  // 5 times as long as the slab, cells of size 1
  CHECK(std::array{wide.cells(0), wide.cells(1), wide.cells(2)} == std::array<int64_t, 3>{20, 18, 17});
  CHECK(around.cells(1) >= 6);
  CHECK(around.cells(1) <= 7);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(around.spacing[axis] == Approx(0.4).epsilon(1e-12));
    const double hi[3] = {4, 2, 1};
    CHECK(around.planes[axis].front() + around.planes[axis].back() == Approx(hi[axis]).epsilon(1e-12));
  }
  // A box whose sides are the same doubles as planes makes no slivers.
  atBothOrientations(box({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}), tenths, [](const CheckedCut& cut, int) { CHECK(cut.cells() == 1000); });
}
