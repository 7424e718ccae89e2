// Which cut-cell of a grid cell holds what floats there: by the vertices that components share, and by rays. In every order of the axes.
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

namespace {

/// Runs `body` with the cut in each order of the axes; the grid must look the same along all of them.
void inAllOrders(const Mesh& mesh, const Grid& grid, const std::function<void(const CheckedCut&)>& body) {
  std::array<int, 3> axes{0, 1, 2};
  do {
    INFO("axes " << axes[0] << axes[1] << axes[2]);
    body(checkedCut(permuted(mesh, axes), grid));
  } while (std::next_permutation(axes.begin(), axes.end()));
}

/// Triangles that share only the centre, as small as to stay within a quarter of it.
Mesh sharedVertexFan(const Point& centre, int count) {
  Mesh mesh{{centre[0], centre[1], centre[2]}, {}};
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.) / count, w = 2.399963 * i, r = 0.25 * std::sqrt(1 - z * z), turn = 0.5 / count;
    const uint32_t first = uint32_t(mesh.vertexCount());
    for (const double angle : {w - turn, w + turn}) {
      for (const double x : {centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), centre[2] + 0.25 * z}) {
        mesh.positions.push_back(x);
      }
    }
    mesh.triangles.insert(mesh.triangles.end(), {0, first, first + 1});
  }
  return mesh;
}

const Point middle = {1.5, 1.5, 1.5};

}  // namespace

TEST_CASE("nesting: triangles that share one vertex divide nothing", "[nesting]") {
  for (const Point& centre : {middle, Point{1.5, 1.5, 1}, Point{1.5, 1, 1}, Point{1, 1, 1}}) {
    inAllOrders(sharedVertexFan(centre, 60), unitGrid(3), [](const CheckedCut& cut) { CHECK(cut.cells() == 27); });
  }
}

TEST_CASE("nesting: triangles on both sides of a surface that has their vertex", "[nesting]") {
  const auto aside = [](const Point& v, double side) {
    return triangle(v, {v[0] + side * 0.25, v[1] + 0.125, v[2] + 0.25}, {v[0] + side * 0.25, v[1] - 0.125, v[2] + 0.25});
  };
  SECTION("inside of one of its triangles, as seen from both") {
    const Mesh wall = quad({1.5, -8, -7}, {1.5, 8, -7}, {1.5, 8, 9}, {1.5, -8, 9});
    for (const double z : {1.25, 1.}) {  // inside of a grid cell, and on a grid-face
      const Point v = {1.5, 1.625, z};
      inAllOrders(merged({wall, aside(v, 1), aside(v, -1)}), unitGrid(3), [](const CheckedCut& cut) {
        CHECK(cut.cells() == 27 + 9);
        CHECK(near(cut.volumesIn(1, 1, 1), {0.5, 0.5}));
      });
    }
  }
  SECTION("as a vertex of its own") {
    for (const double z : {1.25, 1.}) {
      const Point v = {1.5, 1.5, z}, corners[4] = {{1.5, -8, -8}, {1.5, 8, -8}, {1.5, 8, 8}, {1.5, -8, 8}};
      std::vector<Mesh> parts = {aside(v, 1), aside(v, -1)};
      for (int i = 0; i < 4; ++i) parts.push_back(triangle(v, corners[i], corners[(i + 1) % 4]));
      inAllOrders(merged(parts), unitGrid(3), [](const CheckedCut& cut) {
        CHECK(cut.cells() == 27 + 9);
        CHECK(near(cut.volumesIn(1, 1, 1), {0.5, 0.5}));
      });
    }
  }
  SECTION("as the tip of a bubble") {
    for (const Point& tip : {middle, Point{1.5, 1.5, 1}, Point{1.5, 1, 1}, Point{1, 1, 1}}) {
      const auto from = [&](double x, double y, double z) { return Point{tip[0] + x, tip[1] + y, tip[2] + z}; };
      const Mesh bubble = tetrahedron(tip, from(0.375, 0.125, 0.125), from(0.125, 0.375, 0.125), from(0.125, 0.125, 0.375));
      const Mesh within = triangle(tip, from(0.125, 0.125, 0.1875), from(0.125, 0.15625, 0.125));
      const Mesh beside = triangle(tip, from(0.0625, 0.375, 0.375), from(0.03125, 0.375, 0.25));
      const double volume = std::abs(signedVolume(bubble));
      inAllOrders(merged({bubble, within, beside}), unitGrid(3), [&](const CheckedCut& cut) {
        CHECK(cut.cells() == 28);
        CHECK(near(cut.volumesIn(1, 1, 1), {volume, 1 - volume}));
      });
    }
  }
}

TEST_CASE("nesting: bubbles in bubbles with a common tip", "[nesting]") {
  const Mesh outer = tetrahedron({0, 0, 0}, {0.5, 0, 0.125}, {0, 0.5, 0.125}, {0.125, 0.125, 0.5});
  std::vector<Mesh> bubbles;
  for (const double size : {1., 0.75, 0.5}) {  // each narrower, so that they meet only there
    Mesh bubble = outer;
    const double axis[3] = {0.2, 0.2, 0.25};
    for (size_t i = 3; i < bubble.positions.size(); ++i)
      bubble.positions[i] = size * (size * bubble.positions[i] + (1 - size) * axis[i % 3]);
    bubbles.push_back(translated(bubble, {1.25, 1.25, 1.25}));
  }
  std::vector<double> volumes;
  for (const Mesh& bubble : bubbles) volumes.push_back(std::abs(signedVolume(bubble)));
  inAllOrders(merged(bubbles), unitGrid(3), [&](const CheckedCut& cut) {
    CHECK(near(cut.volumesIn(1, 1, 1), {volumes[2], volumes[1] - volumes[2], volumes[0] - volumes[1], 1 - volumes[0]}));
  });
}

TEST_CASE("nesting: two sheets that each have a part of the other behind their first triangle", "[nesting]") {
  const auto sheet = [](bool other) {
    const Point corners[7] = {{1.8125, 1.25, 1.28125}, {1.8125, 1.375, 1.28125},  {1.8125, 1.25, 1.375}, {1.5, 1.25, 1.75},
                              {1.1875, 1.5625, 1.625}, {1.1875, 1.84375, 1.6875}, {1.1875, 1.625, 1.875}};
    Mesh mesh{{}, {0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 6, 4, 5, 6}};
    for (const Point& p : corners) mesh.positions.insert(mesh.positions.end(), {p[0], other ? 3 - p[1] : p[1], other ? 3 - p[2] : p[2]});
    return mesh;
  };
  inAllOrders(merged({sheet(false), sheet(true)}), unitGrid(3), [](const CheckedCut& cut) {
    CHECK(cut.stats.intersections.total() == 0);
    CHECK(cut.cells() == 27);
  });
}

TEST_CASE("nesting: many sheets over each other, and bubbles in bubbles", "[nesting]") {
  std::vector<Mesh> sheets, bubbles;
  for (int i = 0; i < 100; ++i) {
    const double z = 1.25 + i / 256., s = 0.25 + i / 256.;
    sheets.push_back(triangle({1.25, 1.25, z}, {1.75, 1.25 + i / 1024., z}, {1.25, 1.75, z}));
    bubbles.push_back(octahedron(middle, s / 2));
  }
  inAllOrders(merged(sheets), unitGrid(3), [](const CheckedCut& cut) { CHECK(cut.cells() == 27); });
  inAllOrders(merged(bubbles), unitGrid(3), [](const CheckedCut& cut) { CHECK(cut.cells() == 127); });
}
