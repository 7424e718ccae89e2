// Triangles that cross, touch, overlap or occur several times, cut as if their arrangement had been given: numbers known beforehand, in
// every order of the axes, as given and with one triangle's vertices the other way round. Grids are of unit cells from the origin unless
// said otherwise.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;
using namespace shapes;
using vectors::areaAbout;

namespace {

constexpr double big = 10;  // beyond all of these grids
constexpr double pi = 3.14159265358979323846;

struct Variant {
  std::array<int, 3> axes;
  int orientation;   ///< 1, or -1 where the order of the axes turns the mesh inside out
  bool oneReversed;  ///< whether the last triangle's vertices are the other way round
};

/// Runs `body` with the mesh in each order of the axes, as given and with the last triangle reversed. The grid must look the same along all
/// axes.
void inAllOrders(const Mesh& mesh, const Grid& grid, const std::function<void(const CheckedCut&, const Variant&)>& body) {
  Variant variant{{0, 1, 2}, 1, false};
  do {
    const auto& a = variant.axes;
    variant.orientation = (a[0] + 1) % 3 == a[1] ? 1 : -1;
    for (const bool reversed : {false, true}) {
      variant.oneReversed = reversed;
      Mesh placed = permuted(mesh, variant.axes);
      if (reversed) std::swap(placed.triangles[placed.triangles.size() - 1], placed.triangles[placed.triangles.size() - 2]);
      INFO("axes " << a[0] << a[1] << a[2] << (reversed ? ", one triangle reversed" : ""));
      body(checkedCut(placed, grid), variant);
    }
  } while (std::next_permutation(variant.axes.begin(), variant.axes.end()));
}

using Amounts = std::vector<std::pair<int, double>>;

/// Winding number (times the orientation) and volume of each region, ascending.
Amounts windingVolumes(const CheckedCut& cut, int orientation = 1) {
  REQUIRE(cut.mesh.hasWinding);
  const std::vector<double> volumes = regionVolumes(cut.mesh, cut.measures);
  Amounts amounts;
  for (size_t r = 0; r < volumes.size(); ++r) amounts.emplace_back(orientation * cut.mesh.regionWinding[r], volumes[r]);
  std::sort(amounts.begin(), amounts.end());
  return amounts;
}

/// Winding number (times the orientation) and number of cells of each region, ascending.
Amounts windingCells(const CheckedCut& cut, int orientation = 1) {
  REQUIRE(cut.mesh.hasWinding);
  std::vector<double> cells(cut.mesh.regionCount, 0);
  for (const uint32_t r : cut.mesh.cellRegion) ++cells[r];
  UntouchedCells(cut.mesh).forEach([&](const UntouchedCells::Run& run) { cells[run.region] += double(run.count()); });
  Amounts amounts;
  for (size_t r = 0; r < cells.size(); ++r) amounts.emplace_back(orientation * cut.mesh.regionWinding[r], cells[r]);
  std::sort(amounts.begin(), amounts.end());
  return amounts;
}

bool near(const Amounts& a, const Amounts& b, double tolerance = 1e-12) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const auto& x, const auto& y) { return x.first == y.first && std::abs(x.second - y.second) <= tolerance; });
}

size_t parentCount(const CutMesh& mesh, size_t face) { return mesh.faceParentOffsets[face + 1] - mesh.faceParentOffsets[face]; }

/// Per number of parents: the area of such faces.
std::map<size_t, double> areaByParents(const CutMesh& mesh) {
  std::map<size_t, double> areas;
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    if (mesh.faceTriangle[f] < 0) continue;
    std::array<double, 3> sum = {0, 0, 0};
    for (const auto loop : mesh.loops(f)) {
      const auto first = vectors::pointAt(mesh.positions, loop[0]);
      for (size_t i = 1; i + 1 < loop.size(); ++i) {
        using namespace vectors;
        sum = sum + cross(pointAt(mesh.positions, loop[i]) - first, pointAt(mesh.positions, loop[i + 1]) - first);
      }
    }
    areas[parentCount(mesh, f)] += 0.5 * vectors::length(sum);
  }
  return areas;
}

/// Sum over regions of winding number times volume.
double windingSum(const CheckedCut& cut) {
  double sum = 0;
  for (const auto& [winding, volume] : windingVolumes(cut)) sum += winding * volume;
  return sum;
}

Mesh squareAcross(int axis, double at, double lo, double hi) {
  const Mesh square = quad({at, lo, lo}, {at, hi, lo}, {at, hi, hi}, {at, lo, hi});
  return permuted(square, axis == 0 ? std::array<int, 3>{0, 1, 2} : axis == 1 ? std::array<int, 3>{2, 0, 1} : std::array<int, 3>{1, 2, 0});
}

}  // namespace

// ------------------------------------------------------------------------------------------------------------------------ boxes

TEST_CASE("soups: two boxes that cross in a grid cell, along axial planes", "[soups]") {
  inAllOrders(merged({cube(1, 3), cube(2, 4)}), unitGrid(5), [](const CheckedCut& cut, const Variant& variant) {
    CHECK(cut.cells() == 125);
    CHECK(near(cut.regionVolumes(), {1, 7, 7, 110}, 0));
    CHECK(cut.mesh.hasWinding != variant.oneReversed);
    if (variant.oneReversed) return;
    CHECK(windingCells(cut, variant.orientation) == Amounts{{0, 110}, {1, 7}, {1, 7}, {2, 1}});
    CHECK(near(windingVolumes(cut, variant.orientation), {{0, 110}, {1, 7}, {1, 7}, {2, 1}}, 0));
  });
}

TEST_CASE("soups: two boxes that cross within grid cells", "[soups]") {
  const double both = 0.421875;
  inAllOrders(merged({cube(1.25, 3.25), cube(2.5, 4.5)}), unitGrid(5), [&](const CheckedCut& cut, const Variant& variant) {
    CHECK(near(cut.regionVolumes(), {both, 8 - both, 8 - both, 125 - 16 + both}));
    CHECK(cut.mesh.hasWinding != variant.oneReversed);
    if (variant.oneReversed) return;
    CHECK(near(windingVolumes(cut, variant.orientation), {{0, 125 - 16 + both}, {1, 8 - both}, {1, 8 - both}, {2, both}}));
    CHECK(cut.mesh.madeVertices.size() >= 6);
  });
}

TEST_CASE("soups: two boxes of opposite orientation", "[soups]") {
  for (const double shift : {0., 0.25}) {
    const Mesh mesh = merged({cube(1 + shift, 3 + shift), flipped(cube(2 + 2 * shift, 4 + 2 * shift))});
    const double side = 1 - shift, both = side * side * side;
    inAllOrders(mesh, unitGrid(5), [&](const CheckedCut& cut, const Variant& variant) {
      if (variant.oneReversed) return;
      const int sign = variant.orientation;
      CHECK(near(windingVolumes(cut, sign), {{-1, 8 - both}, {0, both}, {0, 125 - 16 + both}, {1, 8 - both}}));
    });
  }
}

TEST_CASE("soups: a cube given twice", "[soups]") {
  for (const double lo : {1., 1.25}) {
    inAllOrders(merged({cube(lo, 3), cube(lo, 3)}), unitGrid(4), [&](const CheckedCut& cut, const Variant& variant) {
      const double volume = (3 - lo) * (3 - lo) * (3 - lo);
      CHECK(near(cut.regionVolumes(), {volume, 64 - volume}));
      CHECK(cut.mesh.droppedTriangles.empty());
      CHECK(areaByParents(cut.mesh).size() == 1);
      CHECK(areaByParents(cut.mesh)[2] == Approx(6 * (3 - lo) * (3 - lo)).epsilon(1e-12));
      if (variant.oneReversed) return;
      CHECK(near(windingVolumes(cut, variant.orientation), {{0, 64 - volume}, {2, volume}}));
    });
  }
}

TEST_CASE("soups: a cube given twice with opposite orientation keeps its walls", "[soups]") {
  for (const double lo : {1., 1.25}) {
    inAllOrders(merged({cube(lo, 3), flipped(cube(lo, 3))}), unitGrid(4), [&](const CheckedCut& cut, const Variant& variant) {
      const double volume = (3 - lo) * (3 - lo) * (3 - lo);
      CHECK(near(cut.regionVolumes(), {volume, 64 - volume}));
      if (variant.oneReversed) return;
      CHECK(near(windingVolumes(cut), {{0, volume}, {0, 64 - volume}}));
      for (const int8_t sign : cut.mesh.faceParentSigns) CHECK(std::abs(sign) == 1);
    });
  }
}

TEST_CASE("soups: a cube given twice with its squares divided the other way", "[soups]") {
  Mesh other = cube(1.25, 3);
  for (size_t t = 0; t < other.triangleCount(); t += 2) {  // squares abc, acd become bcd, bda
    uint32_t* v = &other.triangles[3 * t];
    REQUIRE((v[0] == v[3] && v[2] == v[4]));
    const uint32_t a = v[0], b = v[1], c = v[2], d = v[5];
    const uint32_t turned[6] = {b, c, d, b, d, a};
    std::copy(turned, turned + 6, v);
  }
  inAllOrders(merged({cube(1.25, 3), other}), unitGrid(4), [&](const CheckedCut& cut, const Variant& variant) {
    const double volume = 1.75 * 1.75 * 1.75;
    CHECK(near(cut.regionVolumes(), {volume, 64 - volume}));
    CHECK(cut.mesh.droppedTriangles.empty());
    if (!variant.oneReversed) CHECK(near(windingVolumes(cut, variant.orientation), {{0, 64 - volume}, {2, volume}}));
  });
}

// ------------------------------------------------------------------------------------------------------------------------ sheets

TEST_CASE("soups: two squares that cross inside one cell", "[soups]") {
  const Mesh upright = quad({1.5, 1.25, 1.25}, {1.5, 1.75, 1.25}, {1.5, 1.75, 1.75}, {1.5, 1.25, 1.75});
  const Mesh level = quad({1.25, 1.375, 1.5}, {1.75, 1.375, 1.5}, {1.75, 1.875, 1.5}, {1.25, 1.875, 1.5});
  inAllOrders(merged({upright, level}), unitGrid(3), [](const CheckedCut& cut, const Variant&) {
    CHECK(cut.cells() == 27);
    CHECK(near(cut.volumesIn(1, 1, 1), {1}));
    CHECK(cut.mesh.regionCount == 1);
    CHECK(cut.mesh.madeVertices.size() == 4);  // the ends of the segment, and where it crosses the squares' diagonals
    CHECK(areaByParents(cut.mesh)[1] == Approx(0.5).epsilon(1e-12));
  });
}

TEST_CASE("soups: three squares through the middle of a cell make eight cells of an eighth", "[soups]") {
  const auto eighths = [](const Mesh& mesh) {
    inAllOrders(mesh, unitGrid(3), [](const CheckedCut& cut, const Variant&) {
      CHECK(cut.cells() == 26 + 8);
      CHECK(near(cut.volumesIn(1, 1, 1), std::vector<double>(8, 0.125)));
      CHECK(cut.mesh.regionCount == 1);
    });
  };
  SECTION("where their diagonals meet") {
    eighths(merged({squareAcross(0, 1.5, 0.25, 2.75), squareAcross(1, 1.5, 0.25, 2.75), squareAcross(2, 1.5, 0.25, 2.75)}));
  }
  SECTION("which a cut that does not look for them leaves in one") {
    const Mesh mesh = merged({squareAcross(0, 1.5, 0.25, 2.75), squareAcross(1, 1.5, 0.25, 2.75), squareAcross(2, 1.5, 0.25, 2.75)});
    CutOptions options;
    options.intersections = Intersections::assumeNone;
    const CutResult result = cut(mesh, unitGrid(3), options);
    CHECK((!result || !validate(mesh, result.mesh).pass));
  }
  SECTION("beside their diagonals") {
    eighths(merged({squareAcross(0, 1.5, 0.125, 2.75), squareAcross(1, 1.5, 0.25, 2.5), squareAcross(2, 1.5, 0.375, 2.75)}));
  }
}

TEST_CASE("soups: a triangle whose corner touches the inside of another", "[soups]") {
  const Mesh base = triangle({1.125, 1.125, 1.5}, {1.875, 1.125, 1.5}, {1.125, 1.875, 1.5});
  SECTION("in a cell") {
    inAllOrders(merged({base, triangle({1.25, 1.375, 1.5}, {1.25, 1.5, 1.75}, {1.5, 1.25, 1.75})}), unitGrid(3),
                [](const CheckedCut& cut, const Variant&) {
                  CHECK(cut.cells() == 27);
                  CHECK(near(cut.volumesIn(1, 1, 1), {1}));
                  CHECK(cut.mesh.madeVertices.empty());
                  CHECK(cut.stats.intersections.touching == 1);
                });
  }
  SECTION("through the plane of a grid-face") {
    inAllOrders(merged({translated(base, {0, 0, 0.5}), triangle({1.25, 1.375, 2}, {1.25, 1.5, 2.75}, {1.5, 1.25, 2.75})}), unitGrid(3),
                [](const CheckedCut& cut, const Variant&) { CHECK(cut.cells() == 27); });
  }
  SECTION("as the tip of a tetrahedron on a box") {
    const Mesh tip = tetrahedron({1.25, 1.5, 2.5}, {1.75, 1.25, 2.5}, {1.5, 1.75, 2.5}, {1.5, 1.5, 2.125});
    const Mesh mesh = merged({box({0.5, 0.5, 0.5}, {2.5, 2.25, 2.125}), signedVolume(tip) < 0 ? flipped(tip) : tip});
    const double volume = 2 * 1.75 * 1.625, small = std::abs(signedVolume(tip));
    inAllOrders(mesh, unitGrid(3), [&](const CheckedCut& cut, const Variant& variant) {
      CHECK(near(cut.regionVolumes(), {small, volume, 27 - small - volume}));
      if (variant.oneReversed) return;
      CHECK(near(windingVolumes(cut, variant.orientation), {{0, 27 - small - volume}, {1, small}, {1, volume}}));
    });
  }
}

TEST_CASE("soups: a T-junction in a sheet that divides the grid", "[soups]") {
  const Mesh left = quad({-big, -big, 1.5}, {1.5, -big, 1.5}, {1.5, big, 1.5}, {-big, big, 1.5});
  const Mesh lower = quad({1.5, -big, 1.5}, {big, -big, 1.5}, {big, 1.25, 1.5}, {1.5, 1.25, 1.5});
  const Mesh upper = quad({1.5, 1.25, 1.5}, {big, 1.25, 1.5}, {big, big, 1.5}, {1.5, big, 1.5});
  inAllOrders(merged({left, lower, upper}), unitGrid(3), [](const CheckedCut& cut, const Variant&) {
    CHECK(cut.cells() == 27 + 9);
    CHECK(near(cut.regionVolumes(), {13.5, 13.5}));
    CHECK_FALSE(cut.mesh.hasWinding);
    CHECK(cut.mesh.madeVertices.empty());
    // The vertex where the two end is one of the face on the other side.
    const auto junction = std::find(cut.mesh.vertexTriVertex.begin(), cut.mesh.vertexTriVertex.end(), 7) - cut.mesh.vertexTriVertex.begin();
    size_t leftFaces = 0;
    for (size_t f = 0; f < cut.mesh.faceCount(); ++f) {
      const auto loop = cut.mesh.loops(f)[0];
      leftFaces += (cut.mesh.faceTriangle[f] == 0 || cut.mesh.faceTriangle[f] == 1) &&
                   std::find(loop.begin(), loop.end(), uint32_t(junction)) != loop.end();
    }
    CHECK(leftFaces == 1);
  });
}

TEST_CASE("soups: two squares in one plane that overlap by a quarter", "[soups]") {
  for (const double z : {1.5, 1., 2.}) {  // within cells, and in a grid plane
    for (const bool sameDiagonals : {true, false}) {
      for (const bool sameNormals : {true, false}) {
        const Mesh first = quad({0.5, 0.5, z}, {1.5, 0.5, z}, {1.5, 1.5, z}, {0.5, 1.5, z});
        Mesh second = sameDiagonals ? quad({1, 1, z}, {2, 1, z}, {2, 2, z}, {1, 2, z}) : quad({2, 1, z}, {2, 2, z}, {1, 2, z}, {1, 1, z});
        if (!sameNormals) second = flipped(second);
        inAllOrders(merged({first, second}), unitGrid(3), [&](const CheckedCut& cut, const Variant&) {
          CHECK(cut.mesh.regionCount == 1);
          CHECK(areaByParents(cut.mesh) == std::map<size_t, double>{{1, 1.5}, {2, 0.25}});
        });
      }
    }
  }
}

TEST_CASE("soups: squares in one plane, one inside the other", "[soups]") {
  for (const double z : {1.5, 1.}) {
    const Mesh outer = quad({0.5, 0.5, z}, {2.5, 0.5, z}, {2.5, 2.5, z}, {0.5, 2.5, z});
    const Mesh inner = quad({1.25, 1.25, z}, {1.5, 1.25, z}, {1.5, 1.75, z}, {1.25, 1.75, z});
    inAllOrders(merged({outer, inner, inner}), unitGrid(3), [](const CheckedCut& cut, const Variant&) {
      CHECK(areaByParents(cut.mesh) == std::map<size_t, double>{{1, 3.875}, {3, 0.125}});
    });
  }
}

TEST_CASE("soups: ten squares through one line", "[soups]") {
  const double slopes[10][2] = {{1, 0}, {3, 1}, {2, 1}, {1, 1}, {1, 2}, {0, 1}, {-1, 2}, {-1, 1}, {-2, 1}, {-3, 1}};
  std::vector<Mesh> squares;
  for (const auto& s : slopes) {
    const Point away = {4 * s[0], 4 * s[1], 0}, middle = {1.5, 1.5, 0};
    const auto at = [&](double side, double z) { return Point{middle[0] + side * away[0], middle[1] + side * away[1], z}; };
    squares.push_back(quad(at(-1, -1), at(1, -1), at(1, 4), at(-1, 4)));
  }
  inAllOrders(merged(squares), unitGrid(3), [](const CheckedCut& cut, const Variant& variant) {
    CHECK(cut.mesh.regionCount == 20);
    std::array<int, 3> cell;
    const std::array<int, 3> middle = {1, 1, 0};
    for (int d = 0; d < 3; ++d) cell[d] = middle[variant.axes[d]];
    CHECK(cut.volumesIn(cell[0], cell[1], cell[2]).size() == 20);
  });
}

TEST_CASE("soups: ten thin boxes rotated about one axis, all through one line", "[soups]") {
  std::vector<Mesh> boxes;
  for (int k = 0; k < 10; ++k) {
    const double u = pi * k / 10, c = std::cos(u), s = std::sin(u);
    Mesh plate = box({-1.25, -0.03125, -0.75}, {1.25, 0.03125, 0.75});
    for (size_t v = 0; v < plate.vertexCount(); ++v) {
      double* p = &plate.positions[3 * v];
      const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
      p[0] = x + 1.53125, p[1] = y + 1.5, p[2] += 1.5;
    }
    boxes.push_back(plate);
  }
  double volume = 0;
  for (const Mesh& plate : boxes) volume += signedVolume(plate);
  inAllOrders(merged(boxes), unitGrid(3), [&](const CheckedCut& cut, const Variant& variant) {
    if (variant.oneReversed) return;
    CHECK(variant.orientation * windingSum(cut) == Approx(volume).epsilon(1e-9));
    CHECK(cut.windingVolume(10 * variant.orientation) > 0.0625 * 0.0625 * 0.7);
    CHECK(cut.windingVolume(11 * variant.orientation) == 0);
  });
}

TEST_CASE("soups: a tetrahedron pierced by a needle thinner than 1e-12", "[soups]") {
  const double width = 0x1p-41;  // 4.5e-13
  const Mesh solid = tetrahedron({0.5, 0.5, 0.75}, {2.5, 0.625, 0.75}, {1.25, 2.5, 0.75}, {1.375, 1.25, 2.5});
  REQUIRE(signedVolume(solid) > 0);
  const Mesh needle = box({1.40625, 1.28125, 0.25}, {1.40625 + width, 1.28125 + width, 2.75});
  inAllOrders(merged({solid, needle}), unitGrid(3), [&](const CheckedCut& cut, const Variant& variant) {
    CHECK(cut.mesh.regionCount == 5);
    if (variant.oneReversed) return;
    const Amounts amounts = windingVolumes(cut, variant.orientation);
    std::vector<int> windings;
    for (const auto& [winding, volume] : amounts) windings.push_back(winding);
    CHECK(windings == std::vector<int>{0, 1, 1, 1, 2});
    const double inside = amounts[4].second, ends = amounts[1].second + amounts[2].second;
    CHECK(inside > width * width);  // its way through the solid is longer than 1
    CHECK(inside + ends == Approx(2.5 * width * width).epsilon(0.01));
    CHECK(amounts[3].second == Approx(signedVolume(solid)).epsilon(1e-9));
  });
}

// ------------------------------------------------------------------------------------------------------------------------ surfaces

namespace {

/// A closed surface over the torus of parameters (u, v); row `slices` is row 0, or if `turned` its mirror image.
Mesh closedSurface(int slices, int corners, bool turned, const std::function<Point(int, int)>& at) {
  Mesh mesh;
  for (int i = 0; i < slices; ++i)
    for (int j = 0; j < corners; ++j) {
      const Point p = at(i, j);
      mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    }
  const auto id = [&](int i, int j) {
    j = (j + corners) % corners;
    return uint32_t(i < slices ? i * corners + j : turned ? corners - 1 - j : j);
  };
  for (int i = 0; i < slices; ++i)
    for (int j = 0; j < corners; ++j) {
      const uint32_t a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    }
  return mesh;
}

}  // namespace

TEST_CASE("soups: a spindle torus", "[soups]") {
  // Around the axis, the part of the tube beyond it is inside out: there the tube's two passages cancel.
  const Mesh spindle = torus({1.53125, 1.46875, 1.5}, 0.5, 0.75, 8, 9);
  const double volume = signedVolume(spindle);
  for (const int64_t n : {1, 5}) {
    inAllOrders(spindle, Grid::box({0, 0, 0}, {3, 3, 3}, {n, n, n}), [&](const CheckedCut& cut, const Variant& variant) {
      if (variant.oneReversed) return;
      CHECK(variant.orientation * windingSum(cut) == Approx(volume).epsilon(1e-12));
      CHECK(cut.windingVolume(variant.orientation) > 2);
      CHECK(cut.windingVolume(variant.orientation) + cut.windingVolume(0) == Approx(27).epsilon(1e-12));
      CHECK(cut.mesh.regionCount >= 3);
    });
  }
}

TEST_CASE("soups: a torus whose ring crosses itself", "[soups]") {
  // Its middle line winds about the axis twice, on a limacon.
  const int slices = 48, corners = 12;
  const Mesh mesh = closedSurface(slices, corners, false, [&](int i, int j) {
    const double u = 2 * pi * (i + 0.25) / slices, v = 2 * pi * j / corners, r = 0.4375 + 0.8125 * std::cos(u);
    const double tx = -0.8125 * std::sin(u) * std::cos(u) - r * std::sin(u), ty = -0.8125 * std::sin(u) * std::sin(u) + r * std::cos(u);
    const double length = std::hypot(tx, ty), side = 0.09375 * std::cos(v);
    return Point{1.0625 + r * std::cos(u) + side * ty / length, 1.53125 + r * std::sin(u) - side * tx / length,
                 1.5 + 0.09375 * std::sin(v)};
  });
  const double volume = signedVolume(mesh);
  for (const int64_t n : {1, 5}) {
    inAllOrders(mesh, Grid::box({0, 0, 0}, {3, 3, 3}, {n, n, n}), [&](const CheckedCut& cut, const Variant& variant) {
      CHECK(cut.mesh.regionCount >= 3);
      if (variant.oneReversed) return;
      const int sign = variant.orientation * (volume > 0 ? 1 : -1);
      CHECK(sign * windingSum(cut) == Approx(std::abs(volume)).epsilon(1e-12));
      CHECK(cut.windingVolume(2 * sign) > 0.001);
      CHECK(cut.windingVolume(0) + cut.windingVolume(sign) + cut.windingVolume(2 * sign) == Approx(27).epsilon(1e-12));
    });
  }
}

TEST_CASE("soups: an immersed Klein bottle has two regions and no winding numbers", "[soups]") {
  // A figure of eight that makes half a turn while it goes around. No vertex lies on the line where it crosses itself.
  const int slices = 40, corners = 16;
  const Mesh mesh = closedSurface(slices, corners, true, [&](int i, int j) {
    const double u = 2 * pi * i / slices, v = 2 * pi * (j + 0.5) / corners;
    const double x = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
    const double y = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
    const double r = 0.875 + 0.375 * x;
    return Point{1.53125 + r * std::cos(u), 1.46875 + r * std::sin(u), 1.5 + 0.375 * y};
  });
  for (const int64_t n : {1, 5}) {
    inAllOrders(mesh, Grid::box({0, 0, 0}, {3, 3, 3}, {n, n, n}), [](const CheckedCut& cut, const Variant&) {
      CHECK_FALSE(cut.mesh.hasWinding);
      CHECK(cut.regionVolumes().size() >= 2);
      CHECK(cut.mesh.madeVertices.size() > 20);
    });
  }
}

namespace {

/// Steiner's Roman surface (yz, zx, xy) over one half of a subdivided octahedron that is turned by a matrix.
Mesh romanSurface(int n, const std::array<Point, 3>& turn) {
  const auto at = [&](int i, int j, int k) {
    const Point p = {double(i) / n, double(j) / n, double(k) / n};
    Point q;
    for (int d = 0; d < 3; ++d) q[d] = vectors::dot(turn[d], p);
    return Point{1.5 + q[1] * q[2], 1.5 + q[2] * q[0], 1.5 + q[0] * q[1]};
  };
  std::vector<Mesh> triangles;
  for (const int sx : {1, -1})
    for (const int sy : {1, -1})
      for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {  // z >= 0: the other half is the same again
          const auto corner = [&](int a, int b) { return at(sx * a, sy * b, n - a - b); };
          Mesh up = triangle(corner(i, j), corner(i + 1, j), corner(i, j + 1));
          triangles.push_back(sx * sy > 0 ? up : flipped(up));
          if (i + j + 2 > n) continue;
          Mesh down = triangle(corner(i + 1, j + 1), corner(i, j + 1), corner(i + 1, j));
          triangles.push_back(sx * sy > 0 ? down : flipped(down));
        }
  return merged(triangles);
}

}  // namespace

TEST_CASE("soups: Steiner's Roman surface with its vertices on its double lines", "[soups]") {
  const Mesh mesh = romanSurface(8, {{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}});
  for (const int64_t n : {1, 5}) {
    inAllOrders(mesh, Grid::box({0, 0, 0}, {3, 3, 3}, {n, n, n}), [](const CheckedCut& cut, const Variant& variant) {
      // Four lobes, each closed by the edges that fall onto each other along its double lines.
      CHECK(cut.mesh.regionCount == 5);
      CHECK(cut.mesh.hasWinding != variant.oneReversed);
    });
  }
}

TEST_CASE("soups: Steiner's Roman surface that crosses itself inside of triangles", "[soups]") {
  const Mesh mesh = romanSurface(6, {{{1.6, 1.2, 0}, {-0.96, 1.28, 1.2}, {0.72, -0.96, 1.6}}});
  for (const int64_t n : {1, 5}) {
    inAllOrders(mesh, Grid::box({0, 0, 0}, {3, 3, 3}, {n, n, n}), [](const CheckedCut& cut, const Variant&) {
      CHECK_FALSE(cut.mesh.hasWinding);
      CHECK(cut.mesh.regionCount >= 5);
      CHECK(cut.mesh.madeVertices.size() > 20);
    });
  }
}

TEST_CASE("soups: a hundred random triangles", "[soups]") {
  std::mt19937 random(5);
  Mesh mesh;
  for (uint32_t i = 0; i < 300; ++i) {
    for (int d = 0; d < 3; ++d) mesh.positions.push_back(double(random()) * 0x1p-32);
    mesh.triangles.push_back(i);
  }
  const auto gridOf = [](int64_t n) { return Grid::box({0, 0, 0}, {1, 1, 1}, {n, n, n}); };
  const CheckedCut one = checkedCut(mesh, gridOf(1)), two = checkedCut(mesh, gridOf(2));
  CHECK(one.mesh.madeVertices.size() > 1000);
  CHECK(one.cells() > 100);
  checkedCut(mesh, gridOf(7));
  inAllOrders(mesh, gridOf(2), [&](const CheckedCut& cut, const Variant&) {
    CHECK(cut.cells() == two.cells());
    CHECK(cut.mesh.faceCount() == two.mesh.faceCount());
    CHECK(cut.mesh.vertexCount() == two.mesh.vertexCount());
    CHECK(cut.mesh.madeVertices.size() == two.mesh.madeVertices.size());
  });
}

// ------------------------------------------------------------------------------------------------------------------------ ranges

TEST_CASE("soups: coordinates of all magnitudes give a right answer or a named status", "[soups]") {
  const auto crossing = [](double size, double thickness) {
    return merged({quad({-size, -thickness, 0}, {size, -thickness, 0}, {size, thickness, 0}, {-size, thickness, 0}),
                   quad({0, -size, -thickness}, {0, size, -thickness}, {0, size, thickness}, {0, -size, thickness})});
  };
  for (const auto& [large, small] : std::initializer_list<std::pair<double, double>>{
           {1e300, 1e-300}, {1e300, 1e-310}, {1e300, 1e240}, {1e300, 1e200}, {1, 1e-310}, {1e-290, 1e-310}, {1e150, 1e-20}, {1, 1e-59}}) {
    for (const double box : {large, small, 1.}) {
      INFO("coordinates of " << large << " and " << small << " in a box of " << box);
      const Mesh mesh = crossing(large, small);
      const Grid grid = Grid::box({-box, -box, -box}, {box, box, box}, {3, 3, 3});
      const CutResult result = cut(mesh, grid);
      INFO(name(result.error.status) << " " << result.error.message);
      CHECK(result.error.status != Status::internalError);
      CHECK(result.error.status != Status::selfIntersection);
      if (result) CHECK(validate(mesh, result.mesh).checks[0].pass);
      if (result && result.stats.flushedCoordinates == 0) {
        const Validation validation = validate(mesh, result.mesh);
        for (const Check& check : validation.checks) {
          INFO(check.name << ": " << check.message);
          CHECK(check.pass);
        }
      }
    }
  }
}
