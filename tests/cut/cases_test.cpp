// One test per kind of input that the cutter promises to handle, each with numbers known beforehand and at both orientations of the
// triangles. All grids are of unit cells from the origin unless said otherwise, and all coordinates exact in binary, so that what is
// meant to coincide does.
#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

namespace {

constexpr double big = 10;  // beyond all of these grids

/// The surface of [lo, hi]^2 x [zLo, zHi].
Mesh post(double lo, double hi, double zLo, double zHi) { return box({lo, lo, zLo}, {hi, hi, zHi}); }

Mesh horizontalQuad(double lo, double hi, double z) { return quad({lo, lo, z}, {hi, lo, z}, {hi, hi, z}, {lo, hi, z}); }

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

// ---------------------------------------------------------------------------------------------------------------- closed, open

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

// ---------------------------------------------------------------------------------------------------------------- non-manifold

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

// ---------------------------------------------------------------------------------------------------------------- split, tunnels

TEST_CASE("split cells", "[cases]") {
  SECTION("by a closed slab that leaves the grid") {
    const Mesh slab = box({-big, -big, 1.25}, {big, big, 1.5});
    atBothOrientations(slab, unitGrid(3), [](const CheckedCut& cut, int orientation) {
      CHECK(cut.cells() == 27 + 18);
      CHECK(near(cut.regionVolumes(), {2.25, 11.25, 13.5}));
      CHECK(cut.windingVolume(orientation) == Approx(2.25).epsilon(1e-12));
      CHECK(near(cut.volumesIn(1, 1, 1), {0.25, 0.25, 0.5}));
    });
  }
  SECTION("by three open sheets") {
    const Mesh sheets = merged({horizontalQuad(-big, big, 1.25), horizontalQuad(-big, big, 1.5), horizontalQuad(-big, big, 1.75)});
    atBothOrientations(sheets, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 27);
      CHECK(near(cut.regionVolumes(), {2.25, 2.25, 11.25, 11.25}));
    });
  }
  SECTION("by a gap thinner than any tolerance") {
    const double gap = std::ldexp(1., -40);
    const Mesh sheets = merged({horizontalQuad(-big, big, 1.5), horizontalQuad(-big, big, 1.5 + gap)});
    atBothOrientations(sheets, unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 18);
      CHECK(cut.volumesIn(1, 1, 1).front() == Approx(gap).epsilon(1e-12));
    });
  }
}

TEST_CASE("tunnels: grid-faces with holes", "[cases]") {
  SECTION("one square post") {
    atBothOrientations(post(1.25, 1.75, 0.5, 2.5), unitGrid(3), [](const CheckedCut& cut, int orientation) {
      CHECK(cut.cells() == 27 + 3);
      CHECK(near(cut.regionVolumes(), {0.5, 26.5}));
      CHECK(cut.windingVolume(orientation) == Approx(0.5).epsilon(1e-12));
      for (int plane : {1, 2}) {
        CHECK(cut.facesIn(2, plane, 1) == 1);
        CHECK(cut.facesIn(2, plane, 2) == 0);
      }
    });
  }
  SECTION("a bent tube through the same face twice") {
    const Mesh bent = sweptTube({{1.25, 1.5, 0.5}, {1.25, 1.5, 1.5}, {1.75, 1.5, 1.5}, {1.75, 1.5, 0.5}}, 0.125);
    atBothOrientations(bent, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 3);
      CHECK(near(cut.regionVolumes(), {0.15625, 27 - 0.15625}));
      CHECK(cut.volumesIn(1, 1, 0).size() == 3);
      CHECK(cut.facesIn(2, 1, 2) == 1);
    });
  }
  SECTION("a cell pierced along all axes") {
    const Mesh ring = sweptTube({{1.5, 1.5, 0.5}, {1.5, 1.5, 1.5}, {2.5, 1.5, 1.5}, {2.5, 2.5, 1.5}}, 0.25);
    atBothOrientations(ring, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(near(cut.regionVolumes(), {0.75, 26.25}));
      CHECK(cut.facesIn(0, 2, 1) == 1);
      CHECK(cut.facesIn(1, 2, 1) == 1);
      CHECK(cut.facesIn(2, 1, 1) == 1);
      CHECK(cut.cells() == 27 + 4);
    });
  }
}

TEST_CASE("tunnels: loops nested three deep", "[cases]") {
  const Mesh mesh = merged({post(1.125, 1.875, 0.25, 2.75), flipped(post(1.25, 1.75, 0.5, 2.5)), post(1.375, 1.625, 0.75, 2.25)});
  atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int orientation) {
    CHECK(cut.cells() == 27 + 9);
    CHECK(near(cut.regionVolumes(), {0.09375, 0.40625, 0.90625, 27 - 1.40625}));
    CHECK(cut.windingVolume(orientation) == Approx(1).epsilon(1e-12));
    for (int k : {0, 1, 2}) CHECK(cut.volumesIn(1, 1, k).size() == 4);
    for (int plane : {1, 2}) CHECK(cut.facesIn(2, plane, 1) == 3);
    CHECK(cut.facesWithHoles() == 6);
  });
}

TEST_CASE("tunnels: two nests beside each other in one grid-face", "[cases]") {
  const auto smallPost = [](double x, double w) { return box({x - w, 1.5 - w, 0.5 - w}, {x + w, 1.5 + w, 1.5 + w}); };
  const Mesh mesh =
      merged({smallPost(1.25, 0.1875), flipped(smallPost(1.25, 0.125)), smallPost(1.75, 0.1875), flipped(smallPost(1.75, 0.125))});
  atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
    CHECK(cut.mesh.regionCount == 5);
    CHECK(cut.cells() == 27 + 8);
    CHECK(cut.facesIn(2, 1, 2) == 1);
    CHECK(cut.facesIn(2, 1, 1) == 3);
  });
}

TEST_CASE("tunnels: closed and open tubes", "[cases]") {
  const int slices = 12;
  const double section = slices * 0.25 * 0.25 * std::sin(2 * std::acos(-1.) / slices) / 2;
  SECTION("closed") {
    atBothOrientations(tube({1.5, 1.5, 0.5}, 0.25, 2, slices, true), unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 3);
      CHECK(near(cut.regionVolumes(), {2 * section, 27 - 2 * section}));
    });
  }
  SECTION("open at both ends inside the grid") {
    atBothOrientations(tube({1.5, 1.5, 0.5}, 0.25, 2, slices, false), unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 1);
      CHECK(cut.mesh.regionCount == 1);
      CHECK(near(cut.volumesIn(1, 1, 1), {section, 1 - section}));
      CHECK(near(cut.volumesIn(1, 1, 0), {1}));
    });
  }
  SECTION("open beyond the grid") {
    atBothOrientations(tube({1.5, 1.5, -1}, 0.25, 5, slices, false), unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 3);
      CHECK(near(cut.regionVolumes(), {3 * section, 27 - 3 * section}));
      CHECK_FALSE(cut.mesh.hasWinding);
    });
  }
  SECTION("open, ending on axial planes") {
    atBothOrientations(tube({1.5, 1.5, 1}, 0.25, 1, slices, false), unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 1);
      CHECK(near(cut.volumesIn(1, 1, 1), {section, 1 - section}));
      CHECK(cut.mesh.regionCount == 1);
    });
  }
  SECTION("open, ending inside one cell") {
    atBothOrientations(tube({1.5, 1.5, 1.25}, 0.25, 0.5, slices, false), unitGrid(3),
                       [&](const CheckedCut& cut, int) { CHECK(cut.cells() == 27); });
  }
}

TEST_CASE("tunnels: nested tubes", "[cases]") {
  const Mesh mesh = merged({tube({1.5, 1.5, -1}, 0.375, 5, 12, false), tube({1.5, 1.5, -1}, 0.25, 5, 12, false)});
  atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 27 + 6);
    CHECK(cut.mesh.regionCount == 3);
    CHECK(cut.facesIn(2, 1, 1) == 2);
  });
  const Mesh closedInOpen = merged({tube({1.5, 1.5, 0.5}, 0.375, 2, 12, false), tube({1.5, 1.5, 0.75}, 0.25, 1.5, 12, true)});
  atBothOrientations(closedInOpen, unitGrid(3), [](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 27 + 4);
    CHECK(cut.mesh.regionCount == 2);
  });
}

// ---------------------------------------------------------------------------------------------------------------- bubbles

TEST_CASE("bubbles: a component inside one cell", "[cases]") {
  SECTION("a tetrahedron") {
    const Mesh mesh = tetrahedron({1.25, 1.25, 1.25}, {1.75, 1.25, 1.25}, {1.25, 1.75, 1.25}, {1.25, 1.25, 1.75});
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int orientation) {
      CHECK(cut.cells() == 65);
      CHECK(near(cut.volumesIn(1, 1, 1), {1. / 48, 47. / 48}));
      CHECK(near(cut.regionVolumes(), {1. / 48, 64 - 1. / 48}));
      CHECK(cut.windingVolume(orientation) == Approx(1. / 48).epsilon(1e-12));
    });
  }
  SECTION("two beside each other") {
    const Mesh mesh = merged({octahedron({1.25, 1.5, 1.5}, 0.125), flipped(octahedron({1.75, 1.5, 1.5}, 0.125))});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 29);
      CHECK(cut.volumesIn(1, 1, 1).size() == 3);
      CHECK(cut.windingVolume(1) == Approx(4. / 3 / 512).epsilon(1e-12));
      CHECK(cut.windingVolume(-1) == Approx(4. / 3 / 512).epsilon(1e-12));
    });
  }
  SECTION("beside a surface that splits the cell") {
    const Mesh mesh = merged({octahedron({1.5, 1.5, 1.75}, 0.125), horizontalQuad(-big, big, 1.5)});
    atBothOrientations(mesh, unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 27 + 9 + 1);
      CHECK(near(cut.volumesIn(1, 1, 1), {1. / 384, 0.5 - 1. / 384, 0.5}));
    });
  }
}

TEST_CASE("bubbles: nested bubbles", "[cases]") {
  SECTION("two spheres") {
    const Mesh outer = icosphere({1.5, 1.5, 1.5}, 0.4, 2), inner = icosphere({1.5, 1.5, 1.5}, 0.2, 2);
    const double outerVolume = signedVolume(outer), innerVolume = signedVolume(inner);
    atBothOrientations(merged({outer, inner}), unitGrid(4), [&](const CheckedCut& cut, int orientation) {
      CHECK(near(cut.volumesIn(1, 1, 1), {innerVolume, outerVolume - innerVolume, 1 - outerVolume}));
      CHECK(cut.windingVolume(2 * orientation) == Approx(innerVolume).epsilon(1e-12));
      CHECK(cut.windingVolume(orientation) == Approx(outerVolume - innerVolume).epsilon(1e-12));
    });
  }
  SECTION("three of alternating orientation, and an open sheet in the innermost") {
    const Point c = {1.5, 1.5, 1.5};
    const Mesh mesh = merged({octahedron(c, 0.375), flipped(octahedron(c, 0.25)), octahedron(c, 0.125)});
    atBothOrientations(merged({mesh, horizontalQuad(1.46875, 1.53125, 1.5)}), unitGrid(3), [&](const CheckedCut& cut, int) {
      const double v = 4. / 3 / 512;
      CHECK(near(cut.volumesIn(1, 1, 1), {v, 7 * v, 19 * v, 1 - 27 * v}));
      CHECK(cut.mesh.regionCount == 4);
    });
  }
  SECTION("that touch in a vertex") {
    const Mesh inner = translated(scaled(octahedron({0, 0, 0}, 1), {0.0625, 0.0625, 0.125}), {1.5, 1.5, 1.75});
    const Mesh mesh = merged({octahedron({1.5, 1.5, 1.5}, 0.375), inner});
    atBothOrientations(mesh, unitGrid(3), [&](const CheckedCut& cut, int) {
      const double outerVolume = 4. / 3 * std::pow(0.375, 3), innerVolume = 4. / 3 * 0.0625 * 0.0625 * 0.125;
      CHECK(near(cut.volumesIn(1, 1, 1), {innerVolume, outerVolume - innerVolume, 1 - outerVolume}));
    });
  }
}

TEST_CASE("bubbles: a bubble touching the cell's faces", "[cases]") {
  SECTION("an octahedron with a vertex on all six") {
    atBothOrientations(octahedron({1.5, 1.5, 1.5}, 0.5), unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 65);
      CHECK(near(cut.volumesIn(1, 1, 1), {1. / 6, 5. / 6}));
      CHECK(near(cut.regionVolumes(), {1. / 6, 64 - 1. / 6}));
    });
  }
  SECTION("a box with a side in a face") {
    atBothOrientations(box({1, 1.25, 1.25}, {1.5, 1.75, 1.75}), unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 28);
      CHECK(near(cut.volumesIn(1, 1, 1), {0.125, 0.875}));
    });
  }
  SECTION("a box with sides in three faces") {
    atBothOrientations(cube(1, 1.5), unitGrid(3), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 28);
      CHECK(near(cut.volumesIn(1, 1, 1), {0.125, 0.875}));
    });
  }
  SECTION("a tetrahedron with an edge in a face") {
    const Mesh mesh = tetrahedron({1, 1.25, 1.5}, {1, 1.75, 1.5}, {1.5, 1.5, 1.75}, {1.5, 1.5, 1.25});
    const double volume = std::abs(signedVolume(mesh));
    atBothOrientations(mesh, unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 28);
      CHECK(near(cut.volumesIn(1, 1, 1), {volume, 1 - volume}));
    });
  }
  SECTION("a tetrahedron with a vertex in a grid vertex") {
    const Mesh mesh = tetrahedron({1, 1, 1}, {1.5, 1.25, 1.25}, {1.25, 1.5, 1.25}, {1.25, 1.25, 1.5});
    const double volume = std::abs(signedVolume(mesh));
    atBothOrientations(mesh, unitGrid(3), [&](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 28);
      CHECK(near(cut.volumesIn(1, 1, 1), {volume, 1 - volume}));
    });
  }
  SECTION("an octahedron that touches a grid-face from each side in one vertex") {
    const Mesh mesh = merged({octahedron({1.75, 1.5, 1.5}, 0.25), octahedron({2.25, 1.5, 1.5}, 0.25)});
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) {
      CHECK(cut.cells() == 66);
      CHECK(cut.mesh.regionCount == 3);
    });
  }
}

// ---------------------------------------------------------------------------------------------------------------- degenerate positions

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

// ---------------------------------------------------------------------------------------------------------------- sizes

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

// ---------------------------------------------------------------------------------------------------------------- messy input

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

// ---------------------------------------------------------------------------------------------------------------- statuses

namespace {

CutOptions unresolved() {
  CutOptions options;
  options.intersections = Intersections::assumeNone;
  return options;
}

void fails(const Mesh& mesh, const Grid& grid, Status status, int64_t element, const CutOptions& options = {}) {
  const CutResult result = cut(mesh, grid, options);
  INFO(name(status) << " expected: " << result.error.message);
  CHECK(std::string(name(result.error.status)) == name(status));
  CHECK(result.error.element == element);
  CHECK_FALSE(result.error.message.empty());
  CHECK_FALSE(result);
  CHECK(result.mesh.cellCount() == 0);
  CHECK(result.mesh.vertexCount() == 0);
}

}  // namespace

TEST_CASE("statuses name what is wrong with the mesh", "[cases]") {
  const Grid grid = unitGrid(4);
  fails({}, grid, Status::emptyMesh, -1);
  fails({{0, 0, 0, 1, 1, 1}, {}}, grid, Status::emptyMesh, -1);
  Mesh mesh = cube(1, 3);
  mesh.positions.pop_back();
  fails(mesh, grid, Status::badArrays, -1);
  mesh = cube(1, 3);
  mesh.triangles.push_back(0);
  fails(mesh, grid, Status::badArrays, -1);
  mesh = cube(1, 3);
  mesh.triangles[3 * 7 + 2] = 8;
  fails(mesh, grid, Status::badIndex, 7);
  mesh.triangles[3 * 7 + 2] = 0xffffffffu;
  fails(mesh, grid, Status::badIndex, 7);
  for (double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    mesh = cube(1, 3);
    mesh.positions[3 * 5 + 1] = bad;
    fails(mesh, grid, Status::nonFiniteCoordinate, 5);
  }
}

TEST_CASE("statuses name what is wrong with the grid", "[cases]") {
  const Mesh mesh = cube(1, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> good = {0, 1, 2};
  fails(mesh, Grid(), Status::badGrid, 0);
  fails(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {4, 0, 4}), Status::badGrid, 1);
  fails(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {4, 4, -1}), Status::badGrid, 2);
  fails(mesh, Grid::box({0, 0, 0}, {4, 0, 4}, {4, 4, 4}), Status::badGrid, 1);
  fails(mesh, Grid::box({0, 0, 0}, {4, 4, nan}, {4, 4, 4}), Status::badGrid, 2);
  for (const double margin : {-0.1, -0.5, -0.6, 1e7, nan, infinity, -infinity})
    fails(mesh, Grid::around(mesh, 4, margin), Status::badGrid, 0);
  fails(mesh, Grid::regular({0, 0, 0}, {-1, 1, 1}, {4, 4, 4}), Status::badGrid, 0);
  fails(mesh, Grid::regular({0, 0, 0}, {1, 0, 1}, {4, 4, 4}), Status::badGrid, 1);
  fails(mesh, Grid::regular({0, 1e300, 0}, {1, 1, 1}, {4, 4, 4}), Status::badGrid, 1);  // planes that coincide
  fails(mesh, Grid::rectilinear({{good, {0, 1, 1}, good}}), Status::badGrid, 1);
  fails(mesh, Grid::rectilinear({{good, good, {2, 1, 0}}}), Status::badGrid, 2);
  fails(mesh, Grid::rectilinear({{{0, nan, 1}, good, good}}), Status::badGrid, 0);
  fails(mesh, Grid::rectilinear({{good, good, {0, 1, infinity}}}), Status::badGrid, 2);
  fails(mesh, Grid::rectilinear({{good, {1}, good}}), Status::badGrid, 1);
}

TEST_CASE("statuses name a grid that is too large", "[cases]") {
  const Mesh mesh = cube(1, 3);
  fails(mesh, Grid::regular({0, 0, 0}, {1, 1, 1}, {4, (1 << 24) + 1, 4}), Status::gridTooLarge, 1);
  fails(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {4, 4, std::numeric_limits<int64_t>::max()}), Status::gridTooLarge, 2);
  const CutResult manyRows = cut(mesh, Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1 << 15, 1 << 15}));
  CHECK(std::string(name(manyRows.error.status)) == "gridTooLarge");
  CHECK_FALSE(manyRows.error.message.empty());
}

TEST_CASE("statuses name a wrong option", "[cases]") {
  CutOptions options;
  for (double tolerance : {-1e-9, 0.5, 7., std::numeric_limits<double>::quiet_NaN()}) {
    options.snapTolerance = tolerance;
    fails(cube(1, 3), unitGrid(4), Status::badOption, -1, options);
  }
}

TEST_CASE("unresolved, an input that intersects itself on a grid line is refused by its two triangles", "[cases]") {
  // An edge of the second triangle crosses the grid line x = y = 1 in the point where that line pierces the first.
  const Mesh mesh =
      merged({triangle({0.25, 0.25, 1.5}, {2.75, 0.25, 1.5}, {1, 2.75, 1.5}), triangle({0.25, 0.5, 0.5}, {1.75, 1.5, 2.5}, {1, 2, 1.5})});
  const CutResult result = cut(mesh, Grid::box({0, 0, 0}, {3, 3, 3}, {3, 3, 3}), unresolved());
  INFO(result.error.message);
  REQUIRE(std::string(name(result.error.status)) == "selfIntersection");
  CHECK(std::min(result.error.element, result.error.element2) == 0);
  CHECK(std::max(result.error.element, result.error.element2) == 1);
  CHECK(result.mesh.cellCount() == 0);
}

TEST_CASE("unresolved, an input that intersects itself is cut whole or refused by two triangles", "[cases]") {
  std::vector<Mesh> meshes;
  for (double shift : {0.25, 0.5, 1., 1.25}) {
    meshes.push_back(merged({cube(0.5, 2.5), translated(cube(0.5, 2.5), {shift, shift, shift})}));
    meshes.push_back(merged({cube(0.5, 2.5), translated(cube(0.5, 2.5), {shift, 0, 0})}));  // coplanar overlaps
    meshes.push_back(merged({cube(1, 3), translated(cube(1, 3), {shift, 0, 0})}));          // in axial planes
    meshes.push_back(merged({icosphere({1.5, 1.5, 1.5}, 1, 2), translated(octahedron({1.5, 1.5, 1.5}, 1), {shift, 0, 0})}));
    meshes.push_back(merged(
        {horizontalQuad(0.5, 3.5, 1.5), translated(quad({1, 0.5, 0.5}, {1, 3.5, 0.5}, {1, 3.5, 3.5}, {1, 0.5, 3.5}), {shift, 0, 0})}));
  }
  for (const Mesh& mesh : meshes)
    for (int64_t n : {1, 2, 4, 9}) {
      const Grid grid = Grid::box({0, 0, 0}, {4, 4, 4}, {n, n, n});
      const CutResult result = cut(mesh, grid, unresolved());
      if (result) {
        // Triangles that cross within a cell need not be found, but what comes out must hold together.
        CHECK(result.mesh.cellCount() + UntouchedCells(result.mesh).count() >= size_t(n * n * n));
        continue;
      }
      INFO(result.error.message);
      CHECK(std::string(name(result.error.status)) == "selfIntersection");
      CHECK(result.error.element >= 0);
      CHECK(result.error.element2 >= 0);
      CHECK(result.error.element < int64_t(mesh.triangleCount()));
      CHECK(result.error.element2 < int64_t(mesh.triangleCount()));
      CHECK(result.error.element != result.error.element2);
    }
}

TEST_CASE("progress is told in order and can cancel anywhere", "[cases]") {
  const Mesh mesh = icosphere({2, 2, 2}, 1.3, 4);
  size_t calls = 0;
  int lastStage = 0;
  bool inOrder = true;
  CutOptions options;
  options.progress = [&](const Progress& progress) {
    ++calls;
    inOrder = inOrder && progress.stage && progress.stageIndex >= lastStage && progress.stageIndex < progress.stageCount &&
              progress.done <= progress.total;
    lastStage = progress.stageIndex;
    return true;
  };
  REQUIRE(cut(mesh, unitGrid(4), options));
  CHECK(inOrder);
  CHECK(calls > 5);
  for (size_t stopAt = 1; stopAt <= calls; stopAt += 1 + calls / 20) {
    size_t call = 0;
    options.progress = [&](const Progress&) { return ++call < stopAt; };
    fails(mesh, unitGrid(4), Status::cancelled, -1, options);
    CHECK(call == stopAt);
  }
}

TEST_CASE("a vertex beside a plane through 0 does not lie on it in the user's units", "[cases]") {
  // One side passes the z-axis closer than doubles can tell.
  const Mesh mesh{{0x1.5e5b2dd8c4df6p-3, 0x1.0d92442e1117bp-1, 0x1.b8445315475a9p-3, -0x1.5e5b2dd8c4df4p-3, 0x1.0d92442e1117cp-1,
                   -0x1.b8445315475a5p-3, 0.3, 0.9, 0.1},
                  {0, 1, 2}};
  for (const double scale : {0x1p-60, 1.0, 0x1p60}) {
    Mesh scaled = mesh;
    for (double& x : scaled.positions) x *= scale;
    const double h = 0.5 * scale;
    const Grid grid = Grid::regular({-2 * scale, -2 * scale, -2 * scale}, {h, h, h}, {8, 8, 8});
    const CutResult result = cut(scaled, grid);
    REQUIRE(result);
    for (size_t v = 0; v < result.mesh.vertexCount(); ++v) {
      for (size_t d = 0; d < 3; ++d) {
        const double low = -2 * scale + h * result.mesh.vertexCell[3 * v + d], x = result.mesh.positions[3 * v + d];
        const bool isOnPlane = result.mesh.vertexMask[v] >> d & 1;
        CHECK((isOnPlane ? x == low : x > low && x < low + h));
      }
    }
  }
}
