// Grid cells that are split, tunnels and bubbles, each with numbers known beforehand and at both orientations of the triangles.
#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

namespace {

constexpr double big = 10;  // beyond all of these grids

/// The surface of [lo, hi]^2 x [zLo, zHi].
Mesh post(double lo, double hi, double zLo, double zHi) { return box({lo, lo, zLo}, {hi, hi, zHi}); }

}  // namespace

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
