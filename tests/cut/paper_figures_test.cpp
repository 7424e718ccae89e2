// The paper's figures and difficult cases (5.1, 5.4, 5.5) with shapes made here.
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

TEST_CASE("wedge", "[figures]") {
  // A tetrahedron cut out of two cells through their common face, by 0 to 3 vertices of its triangle on that face's sides. With one or
  // two there, or with three that leave the face in one piece, all of the triangle's vertices may lie on the loop around it (Fig. 16).
  const Grid grid = unitGrid(1, 1, 2);
  struct Variant {
    Point a, b, c;
    size_t pieces;  // of the common face, the triangle included
    size_t holes;
  };
  const Variant variants[] = {
      {{0.25, 0.25, 1}, {0.75, 0.25, 1}, {0.5, 0.75, 1}, 2, 1},  // inside
      {{0.5, 0, 1}, {0.75, 0.5, 1}, {0.25, 0.5, 1}, 2, 0},       // one vertex on a side: the other piece runs around it
      {{0, 0, 1}, {0.75, 0.25, 1}, {0.25, 0.75, 1}, 2, 0},       // one vertex in a grid vertex
      {{0.25, 0, 1}, {1, 0.5, 1}, {0.5, 0.5, 1}, 3, 0},          // on two sides
      {{0.25, 0, 1}, {0.75, 0, 1}, {0.5, 0.5, 1}, 2, 0},         // an edge in a side
      {{0.5, 0, 1}, {1, 0.5, 1}, {0, 0.5, 1}, 4, 0},             // on three sides
      {{0, 0, 1}, {1, 0, 1}, {0.5, 1, 1}, 3, 0},                 // in two grid vertices and on a side
      {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, 2, 0},                   // in three grid vertices
  };
  for (const Variant& variant : variants) {
    const Mesh mesh = wedge(variant.a, variant.b, variant.c, 0.375, 1.75);
    const double volume = signedVolume(mesh);
    REQUIRE(volume > 0);
    atBothOrientations(mesh, grid, [&](const CheckedCut& cut, int orientation) {
      CHECK(near(cut.regionVolumes(), {volume, 2 - volume}));
      CHECK(cut.windingVolume(orientation) == Approx(volume).epsilon(1e-12));
      CHECK(cut.volumesIn(0, 0, 0).size() == 2);
      CHECK(cut.volumesIn(0, 0, 1).size() == 2);
      CHECK(cut.facesIn(2, 1) == variant.pieces);
      CHECK(cut.facesIn(2, 1, 1) == variant.holes);
    });
  }
}

TEST_CASE("empty cone", "[figures]") {
  const Mesh mesh = emptyCone();
  const double shell = signedVolume(mesh);
  atBothOrientations(mesh, unitGrid(1, 1, 2), [&](const CheckedCut& cut, int orientation) {
    const double hollow = 0.75 * 0.75 / 2 * 0.5 / 3;
    CHECK(near(cut.volumesIn(0, 0, 0), {hollow * 0.75, hollow, 1 - hollow * 1.75}));
    CHECK(shell == Approx(hollow * 0.75).epsilon(1e-12));
    CHECK(near(cut.volumesIn(0, 0, 1), {1}));
    CHECK(near(cut.regionVolumes(), {shell, 2 - shell}));
    CHECK(cut.windingVolume(orientation) == Approx(shell).epsilon(1e-12));
    CHECK(cut.facesIn(2, 1) == 2);  // the opening, and all around it
  });
}

TEST_CASE("claw", "[figures]") {
  const Mesh mesh = claw();
  const double volume = signedVolume(mesh), prong = 0.125 * 0.25 / 2 * 0.75 / 3;
  REQUIRE(volume > 0);
  atBothOrientations(mesh, unitGrid(1, 1, 2), [&](const CheckedCut& cut, int orientation) {
    CHECK(near(cut.regionVolumes(), {volume, 2 - volume}));
    CHECK(cut.windingVolume(orientation) == Approx(volume).epsilon(1e-12));
    CHECK(near(cut.volumesIn(0, 0, 1), {prong, prong, prong, 1 - 3 * prong}));  // three fingers, not one with three bases
    CHECK(near(cut.volumesIn(0, 0, 0), {volume - 3 * prong, 1 - volume + 3 * prong}));
    CHECK(cut.facesIn(2, 1) == 4);
  });
}

TEST_CASE("oscillator", "[figures]") {
  const int slices = 16;
  const Mesh mesh = oscillator(slices);
  const double volume = signedVolume(mesh);
  REQUIRE(volume > 0);
  atBothOrientations(mesh, unitGrid(1, 1, 2), [&](const CheckedCut& cut, int orientation) {
    CHECK(near(cut.regionVolumes(), {volume, 2 - volume}));
    CHECK(cut.windingVolume(orientation) == Approx(volume).epsilon(1e-12));
    // Outside and four punctured discs down to the last, which is whole: they cross the plane at the rim and at three radii inside.
    CHECK(cut.facesIn(2, 1) == 5);
    CHECK(cut.facesIn(2, 1, 1) == 4);
    CHECK(cut.volumesIn(0, 0, 1).size() == 3);  // the peak, one ring, and all around them
    CHECK(cut.volumesIn(0, 0, 0).size() == 4);  // the body, two moats, and all around it
  });
}

namespace {

/// Fig. 18: a tube along the curve, closed and with a closed hollow; its ends reach an eighth beyond those of the hollow.
Mesh hollowHilbertCurve(int order, double wide, double thin) {
  const std::vector<Point> path = hilbertCurve(order);
  std::vector<Point> outerPath = path;
  for (int d = 0; d < 3; ++d) {
    outerPath.front()[d] -= 0.125 * (path[1][d] - path[0][d]);
    outerPath.back()[d] += 0.125 * (path[path.size() - 1][d] - path[path.size() - 2][d]);
  }
  return merged({sweptTube(outerPath, wide), flipped(sweptTube(path, thin))});
}

}  // namespace

TEST_CASE("hollow Hilbert curve", "[figures]") {
  const double wide = 0.375, thin = 0.25;
  for (int order : {1, 2}) {
    const double steps = std::pow(8, order) - 1;
    const double outer = 4 * wide * wide * (steps + 0.25), inner = 4 * thin * thin * steps;
    const Mesh mesh = hollowHilbertCurve(order, wide, thin);
    REQUIRE(signedVolume(mesh) == Approx(outer - inner).epsilon(1e-12));
    const double lo = -0.75, hi = std::ldexp(1., order) - 0.25, box = std::pow(hi - lo, 3);
    std::vector<double> expected = {inner, outer - inner, box - outer};
    std::sort(expected.begin(), expected.end());
    for (int64_t n : {1, 2, 3, 7})
      atBothOrientations(mesh, Grid::box({lo, lo, lo}, {hi, hi, hi}, {n, n, n}), [&](const CheckedCut& cut, int orientation) {
        CHECK(near(cut.regionVolumes(), expected, 1e-11));
        CHECK(cut.windingVolume(orientation) == Approx(outer - inner).epsilon(1e-12));
      });
  }
  SECTION("its tunnels pierce faces without touching their sides") {
    // Planes half way between the points of the curve: each step from one cell to another goes through the middle of a face.
    atBothOrientations(hollowHilbertCurve(1, wide, thin), Grid::box({-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}, {2, 2, 2}),
                       [](const CheckedCut& cut, int) {
                         CHECK(cut.cells() == 8 * 3);
                         CHECK(cut.facesWithHoles() == 7 * 2);
                       });
    atBothOrientations(hollowHilbertCurve(2, wide, thin), Grid::box({-0.5, -0.5, -0.5}, {3.5, 3.5, 3.5}, {2, 2, 2}),
                       [](const CheckedCut& cut, int) {
                         CHECK(cut.cells() == 8 * 3);
                         CHECK(cut.facesWithHoles() == 7 * 2);
                       });
  }
}

TEST_CASE("wavy plane", "[figures]") {
  const auto wave = [](double amplitude, double height) {
    return [=](int i, int j) {
      return Point{-0.5 + i * 0.25, -0.5 + j * 0.25, height + amplitude * std::sin(0.9 * i) * std::cos(0.7 * j)};
    };
  };
  SECTION("thick and closed, leaving the grid") {
    const Mesh mesh = thickened(20, 20, wave(0.45, 2.01), {0, 0, 0.15});
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int orientation) {
      CHECK(cut.mesh.regionCount == 3);
      CHECK(cut.windingVolume(orientation) == Approx(16 * 0.15).epsilon(1e-12));  // the layer is as thick everywhere
    });
  }
  SECTION("thick and closed, ending in cells") {
    const auto at = [&](int i, int j) {
      const Point p = wave(0.45, 2.01)(i, j);
      return Point{p[0] + 1, p[1] + 1, p[2]};
    };
    const Mesh mesh = thickened(12, 12, at, {0, 0, 0.03125});
    const double volume = signedVolume(mesh);
    for (int64_t n : {2, 4, 11})
      atBothOrientations(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {n, n, n}), [&](const CheckedCut& cut, int) {
        CHECK(near(cut.regionVolumes(), {volume, 64 - volume}, 1e-11));
      });
  }
  SECTION("open, leaving the grid") {
    const Mesh mesh = sheet(20, 20, wave(0.45, 2));
    atBothOrientations(mesh, unitGrid(4), [](const CheckedCut& cut, int) { CHECK(cut.mesh.regionCount == 2); });
  }
  SECTION("open, ending in cells: partial cuts around fully split cells (Fig. 20)") {
    const auto at = [&](int i, int j) {
      const Point p = wave(0.3, 2.5)(i, j);
      return Point{p[0] + 1, p[1] + 1, p[2]};
    };
    for (int64_t n : {1, 4, 11})
      atBothOrientations(sheet(12, 12, at), Grid::box({0, 0, 0}, {4, 4, 4}, {n, n, n}),
                         [](const CheckedCut& cut, int) { CHECK(cut.mesh.regionCount == 1); });
    const CheckedCut cut = checkedCut(sheet(12, 12, at), unitGrid(4));
    CHECK(cut.volumesIn(0, 0, 2).size() == 1);
    CHECK(cut.volumesIn(1, 1, 2).size() == 2);
  }
}

TEST_CASE("a protruding tetrahedron makes faces with two boundary loops", "[figures]") {
  // The inset of 3.4: a tip through two grid-faces that crosses no grid-edge.
  const Mesh mesh = tetrahedron({0.5, 0.25, 0.25}, {0.5, 0.75, 0.25}, {0.5, 0.5, 0.75}, {2.5, 0.5, 0.5});
  const double volume = std::abs(signedVolume(mesh));
  atBothOrientations(mesh, unitGrid(3), [&](const CheckedCut& cut, int) {
    CHECK(cut.cells() == 27 + 3);
    CHECK(near(cut.regionVolumes(), {volume, 27 - volume}));
    CHECK(cut.facesWithHoles() == 2);
  });
}
