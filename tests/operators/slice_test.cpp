// Cross-sections: they cover the grid's cross-section once, follow the surface, and agree with cellsAt().
#include "mandoline/slice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "catch.h"
#include "checked_cut.h"
#include "mandoline/locate.h"
#include "refusal.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;
using namespace vectors;

namespace {

using Point = shapes::Point;

Point unit(const Point& a) {
  const double scale = length(a);
  return {a[0] / scale, a[1] / scale, a[2] / scale};
}

Point pointOf(const Slice& slice, uint32_t p) { return pointAt(slice.positions, p); }
std::span<const uint32_t> loopOf(const Slice& slice, size_t l) { return itemsOf(slice.loopOffsets, slice.loopPoints, l); }
double loopArea(const Slice& slice, const Point& normal, size_t l) { return areaAbout(normal, slice.positions, loopOf(slice, l)); }
double polygonArea(const Slice& slice, const Point& normal, size_t polygon) {
  double sum = 0;
  for (uint32_t l = slice.polygonLoopOffsets[polygon]; l < slice.polygonLoopOffsets[polygon + 1]; ++l) sum += loopArea(slice, normal, l);
  return sum;
}
std::vector<double> regionAreas(const CutMesh& mesh, const Slice& slice, const Point& normal) {
  std::vector<double> areas(mesh.regionCount, 0);
  for (size_t p = 0; p < slice.polygonCount(); ++p) areas[slice.polygonRegion[p]] += polygonArea(slice, normal, p);
  return areas;
}

/// Area of the plane in the grid's box: a large square in the plane, clipped.
double boxArea(const Grid& grid, const Plane& plane) {
  const Point n = unit(plane.normal);
  const double offset = plane.offset / std::sqrt(dot(plane.normal, plane.normal));
  const Point axis = std::fabs(n[0]) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0}, u = unit(cross(n, axis)), v = cross(n, u);
  double size = 0;
  for (const auto& planes : grid.planes) size += std::fabs(planes.front()) + std::fabs(planes.back());
  size = 2 * (size + std::fabs(offset));
  std::vector<Point> polygon;
  for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Point p;
    for (int d = 0; d < 3; ++d) p[d] = std::fabs(n[d]) == 1 ? plane.offset / plane.normal[d] : offset * n[d] + size * (s * u[d] + t * v[d]);
    polygon.push_back(p);
  }
  for (int side = 0; side < 6; ++side) {
    const int d = side / 2;
    const double x = side % 2 ? grid.planes[d].back() : grid.planes[d].front(), sign = side % 2 ? -1 : 1;
    std::vector<Point> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double sa = sign * (a[d] - x), sb = sign * (b[d] - x);
      if (sa >= 0) kept.push_back(a);
      if ((sa > 0 && sb < 0) || (sa < 0 && sb > 0)) {
        kept.push_back({});
        for (int e = 0; e < 3; ++e) kept.back()[e] = a[e] + sa / (sa - sb) * (b[e] - a[e]);
      }
    }
    polygon = kept;
  }
  double area = 0;
  for (size_t i = 1; i + 1 < polygon.size(); ++i) area += areaAbout(n, polygon[0], polygon[i], polygon[i + 1]);
  return std::fabs(area);
}

/// Signed area inside of an oriented mesh's own cross-section, from its triangles alone.
double meshArea(const Mesh& mesh, const Plane& plane) {
  const Point n = unit(plane.normal);
  double area = 0;
  Point origin{};
  bool hasOrigin = false;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    Point corner[3], start, end;
    double height[3];
    for (int i = 0; i < 3; ++i) {
      for (int d = 0; d < 3; ++d) corner[i][d] = mesh.positions[3 * mesh.triangles[3 * t + i] + d];
      height[i] = dot(plane.normal, corner[i]) - plane.offset;
    }
    int crossings = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if ((height[i] >= 0) == (height[j] >= 0)) continue;
      ++crossings;
      for (int d = 0; d < 3; ++d)
        (height[i] >= 0 ? start : end)[d] = corner[i][d] + height[i] / (height[i] - height[j]) * (corner[j][d] - corner[i][d]);
    }
    if (crossings == 0) continue;
    if (!hasOrigin) origin = start;
    hasOrigin = true;
    area += areaAbout(n, origin, start, end);
  }
  return area;
}

/// Whether two segments cross by more than rounding, seen along the normal.
bool cross2(const Point& n, const Point& a, const Point& b, const Point& c, const Point& d, double tolerance) {
  const auto side = [&](const Point& p, const Point& q, const Point& r) {
    const double area = areaAbout(n, p, q, r);
    return area > tolerance ? 1 : area < -tolerance ? -1 : 0;
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

/// What holds for any plane. Lengths around 4.
Slice checkedSlice(const CutMesh& mesh, const Plane& plane) {
  constexpr double kTolerance = 1e-12;
  INFO("plane " << plane.normal[0] << " " << plane.normal[1] << " " << plane.normal[2] << " = " << plane.offset);
  const Slice s = slice(mesh, plane);
  const double length = std::sqrt(dot(plane.normal, plane.normal));
  double farthest = 0;
  for (uint32_t p = 0; p < s.positions.size() / 3; ++p)
    farthest = std::max(farthest, std::fabs(dot(plane.normal, pointOf(s, p)) - plane.offset) / length);
  CHECK(farthest < kTolerance);

  double total = 0, worstCover = 0, leastTriangle = 0, leastOutline = 0, largestHole = 0;
  bool inGridCell = true, regions = true, crosses = false;
  for (size_t p = 0; p < s.polygonCount(); ++p) {
    const double area = polygonArea(s, plane.normal, p);
    total += area;
    double covered = 0;
    for (uint32_t t = s.polygonTriangleOffsets[p]; t < s.polygonTriangleOffsets[p + 1]; ++t) {
      const double triangle =
          areaAbout(plane.normal, pointOf(s, s.triangles[3 * t]), pointOf(s, s.triangles[3 * t + 1]), pointOf(s, s.triangles[3 * t + 2]));
      covered += triangle;
      leastTriangle = std::min(leastTriangle, triangle);
    }
    worstCover = std::max(worstCover, std::fabs(covered - area));
    const uint32_t begin = s.polygonLoopOffsets[p], end = s.polygonLoopOffsets[p + 1];
    REQUIRE(begin < end);
    leastOutline = std::min(leastOutline, loopArea(s, plane.normal, begin));
    std::vector<std::array<uint32_t, 2>> edges;
    for (uint32_t l = begin; l < end; ++l) {
      if (l > begin) largestHole = std::max(largestHole, loopArea(s, plane.normal, l));
      const auto loop = loopOf(s, l);
      for (size_t i = 0; i < loop.size(); ++i) edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
    }
    for (size_t i = 0; i < edges.size() && edges.size() < 400; ++i) {
      for (size_t j = 0; j < i; ++j) {
        crosses |= cross2(plane.normal, pointOf(s, edges[i][0]), pointOf(s, edges[i][1]), pointOf(s, edges[j][0]), pointOf(s, edges[j][1]),
                          kTolerance);
      }
      for (int d = 0; d < 3; ++d) {
        const int32_t g = s.polygonGridCell[3 * p + d];
        const double x = pointOf(s, edges[i][0])[d];
        inGridCell &= mesh.grid.planes[d][size_t(g)] <= x && x <= mesh.grid.planes[d][size_t(g) + 1];
      }
    }
    if (s.polygonCell[p] >= 0) {
      const size_t c = size_t(s.polygonCell[p]);
      regions &= s.polygonRegion[p] == mesh.cellRegion[c] &&
                 std::equal(&s.polygonGridCell[3 * p], &s.polygonGridCell[3 * p] + 3, &mesh.cellGridCell[3 * c]);
    }
  }
  CHECK(total == Approx(boxArea(mesh.grid, plane)).margin(1e-11));
  CHECK(worstCover < kTolerance);
  CHECK(leastTriangle > -kTolerance);
  CHECK(leastOutline > -kTolerance);
  CHECK(largestHole < kTolerance);
  CHECK(inGridCell);
  CHECK(regions);
  CHECK_FALSE(crosses);
  return s;
}

/// The middles of the fill's triangles lie in the cells that they are said to lie in.
void requireLocated(const CutMesh& mesh, const Slice& s, const Plane& plane) {
  std::vector<double> points;
  std::vector<size_t> polygons;
  for (size_t p = 0; p < s.polygonCount(); ++p) {
    for (uint32_t t = s.polygonTriangleOffsets[p]; t < s.polygonTriangleOffsets[p + 1]; ++t) {
      const Point a = pointOf(s, s.triangles[3 * t]), b = pointOf(s, s.triangles[3 * t + 1]), c = pointOf(s, s.triangles[3 * t + 2]);
      if (areaAbout(plane.normal, a, b, c) < 1e-6) continue;
      for (int d = 0; d < 3; ++d) points.push_back((a[d] + b[d] + c[d]) / 3);
      polygons.push_back(p);
    }
  }
  const Locations locations = cellsAt(mesh, points);
  size_t wrong = 0;
  for (size_t i = 0; i < polygons.size(); ++i)
    wrong += locations.cell[i] != s.polygonCell[polygons[i]] || locations.region[i] != int32_t(s.polygonRegion[polygons[i]]);
  CHECK(polygons.size() > 0);
  CHECK(wrong == 0);
}

bool isSame(const Slice& a, const Slice& b) {
  return a.positions == b.positions && a.loopOffsets == b.loopOffsets && a.loopPoints == b.loopPoints &&
         a.polygonLoopOffsets == b.polygonLoopOffsets && a.polygonCell == b.polygonCell && a.polygonGridCell == b.polygonGridCell &&
         a.polygonRegion == b.polygonRegion && a.polygonTriangleOffsets == b.polygonTriangleOffsets && a.triangles == b.triangles;
}

std::vector<Plane> randomPlanes(const Point& centre, double spread, int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return 2 * (double(random()) * 0x1p-32) - 1; };
  std::vector<Plane> planes;
  for (int i = 0; i < count; ++i) {
    const Point normal = {number(), number(), number()},
                through = {centre[0] + spread * number(), centre[1] + spread * number(), centre[2] + spread * number()};
    planes.push_back({normal, dot(normal, through)});
  }
  return planes;
}

const Mesh& closedShapes() {
  using namespace shapes;
  static const Mesh mesh =
      merged({icosphere({1.3, 1.2, 1.4}, 0.9, 2), flipped(icosphere({1.3, 1.2, 1.4}, 0.5, 1)), torus({3.05, 3.05, 2.7}, 0.7, 0.2, 12, 6),
              octahedron({2.5, 2.5, 0.5}, 0.25), cube(3.25, 3.75), noisySphere({0.9, 3.1, 3.0}, 0.6, 0.3, 2)});
  return mesh;
}

const Mesh& openShapes() {
  using namespace shapes;
  static const Mesh mesh =
      merged({fan({0.7, 3.3, 0.4}, 2.5, {{0.3, 0.2}, {-0.3, 0.2}, {0, -0.4}}), moebius({3.2, 1, 3.3}, 0.4, 0.3, 12),
              quad({2.2, 3.2, 0.3}, {2.8, 3.2, 0.3}, {2.8, 3.8, 0.4}, {2.2, 3.8, 0.4}), tube({1.5, 1.4, 0.3}, 0.6, 1.2, 9, false),
              quad({0.2, 0.2, 2.5}, {3.8, 0.3, 2.6}, {3.7, 2.2, 2.7}, {0.4, 2.4, 2.6})});
  return mesh;
}

}  // namespace

TEST_CASE("random planes", "[slice]") {
  for (const bool closed : {true, false}) {
    const Mesh& mesh = closed ? closedShapes() : openShapes();
    for (const auto& cells : std::vector<std::array<int64_t, 3>>{{4, 4, 4}, {1, 1, 1}, {3, 7, 5}, {16, 16, 16}}) {
      const CutResult cut = mandoline::cut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, cells));
      REQUIRE(cut);
      for (const Plane& plane : randomPlanes({2, 2, 2}, 2, 20, unsigned(cells[0]))) {
        const Slice s = checkedSlice(cut.mesh, plane);
        requireLocated(cut.mesh, s, plane);
        if (!closed) continue;
        const std::vector<double> areas = regionAreas(cut.mesh, s, plane.normal);
        double inside = 0;
        for (size_t r = 0; r < areas.size(); ++r) inside += areas[r] * cut.mesh.regionWinding[r];
        CHECK(inside == Approx(meshArea(mesh, plane)).margin(1e-11));
      }
    }
  }
}

TEST_CASE("axial planes, through faces of cells and of the surface, and along the border", "[slice]") {
  const Mesh mesh = shapes::merged({closedShapes(), shapes::quad({2.25, 3.25, 1}, {2.75, 3.25, 1}, {2.75, 3.75, 1}, {2.25, 3.75, 1})});
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  for (int d = 0; d < 3; ++d) {
    for (int quarter = 0; quarter <= 16; ++quarter) {
      for (const double sign : {1., -1.}) {
        Plane plane = {{0, 0, 0}, sign * quarter / 4.};
        plane.normal[size_t(d)] = sign;
        CHECK(boxArea(cut.mesh.grid, plane) == Approx(16));
        checkedSlice(cut.mesh, plane);
      }
    }
  }
}

TEST_CASE("planes through vertices and edges", "[slice]") {
  for (const Mesh& mesh : {shapes::cube(0.5, 2.5), shapes::octahedron({1.5, 1.5, 1.5}, 1.25), openShapes()}) {
    const CheckedCut cut = checkedCut(mesh, unitGrid(4));
    std::mt19937 random(7);
    for (int i = 0; i < 60; ++i) {
      Plane plane;
      do {
        for (double& n : plane.normal) n = double(int(random() % 5) - 2);
      } while (dot(plane.normal, plane.normal) == 0);
      const size_t v = random() % cut.mesh.vertexCount();
      plane.offset = dot(plane.normal, {cut.mesh.positions[3 * v], cut.mesh.positions[3 * v + 1], cut.mesh.positions[3 * v + 2]});
      checkedSlice(cut.mesh, plane);
    }
    for (int i = 0; i < 60; ++i) {  // nearly through three vertices
      Point p[3];
      for (Point& q : p) std::copy_n(&cut.mesh.positions[3 * (random() % cut.mesh.vertexCount())], 3, q.begin());
      const Point normal = cross(p[1] - p[0], p[2] - p[0]);
      if (dot(normal, normal) > 1e-6) checkedSlice(cut.mesh, {normal, dot(normal, p[0])});
    }
  }
}

TEST_CASE("a sphere's cross-section is a disc of its region", "[slice]") {
  const Mesh mesh = shapes::icosphere({0, 0, 0}, 1, 5);
  const CheckedCut cut = checkedCut(mesh, Grid::around(mesh, 10));
  REQUIRE(cut.mesh.regionCount == 2);
  const uint32_t inside = cut.mesh.regionWinding[0] == 1 ? 0 : 1;
  const Plane plane = {{1, 2, 3}, 0.5 * std::sqrt(14)};
  const Slice s = checkedSlice(cut.mesh, plane);
  CHECK(regionAreas(cut.mesh, s, plane.normal)[inside] == Approx(0.75 * std::numbers::pi).epsilon(2e-3));
}

TEST_CASE("cells within cells give holes", "[slice]") {
  using namespace shapes;
  std::vector<Mesh> cubes;
  for (int i = 1; i < 8; ++i) cubes.push_back(cube(0.1 * i, 4 - 0.1 * i));
  cubes.push_back(box({1, 1, 1}, {1.5, 1.5, 3}));
  cubes.push_back(box({2, 2, 1}, {2.5, 2.5, 3}));
  cubes.push_back(quad({1.1, 3, 1}, {1.9, 3, 1}, {1.9, 3, 3}, {1.1, 3, 3}));
  const CheckedCut cut = checkedCut(merged(cubes), Grid::box({0, 0, 0}, {4, 4, 4}, {1, 1, 1}));
  REQUIRE(cut.mesh.cellCount() == 10);
  const Slice s = checkedSlice(cut.mesh, {{0, 0, 1}, 2});
  CHECK(s.polygonCount() == 10);
  CHECK(s.loopOffsets.size() - 1 == 10 + 9 + 1);
  std::vector<uint32_t> loops;
  for (size_t p = 0; p < 10; ++p) loops.push_back(s.polygonLoopOffsets[p + 1] - s.polygonLoopOffsets[p]);
  std::sort(loops.begin(), loops.end());
  CHECK(loops == std::vector<uint32_t>{1, 1, 2, 2, 2, 2, 2, 2, 2, 4});  // the innermost cube has two boxes and a slit
}

TEST_CASE("a cell may have several polygons, each with its own holes", "[slice]") {
  using namespace shapes;
  // A bracket whose two arms the plane cuts, with an empty box in each arm.
  const Mesh bracket = sweptTube({{1, 3.5, 2}, {1, 1, 2}, {3, 1, 2}, {3, 3.5, 2}}, 0.5);
  const Mesh mesh = merged({bracket, flipped(box({0.75, 2, 1.75}, {1.25, 3, 2.25})), flipped(box({2.75, 2, 1.75}, {3.25, 3, 2.25}))});
  const CheckedCut cut = checkedCut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {1, 1, 1}));
  const Plane plane = {{0, 1, 0}, 2.5};
  const Slice s = checkedSlice(cut.mesh, plane);
  std::map<int32_t, int> polygons;
  for (size_t p = 0; p < s.polygonCount(); ++p) {
    ++polygons[s.polygonCell[p]];
    const double area = polygonArea(s, plane.normal, p);
    CHECK((area == Approx(16 - 2) || area == Approx(1 - 0.25) || area == Approx(0.25)));
  }
  CHECK(s.polygonCount() == 5);
  CHECK(std::any_of(polygons.begin(), polygons.end(), [](const auto& entry) { return entry.second == 2; }));
}

TEST_CASE("a sheet that ends within a cell is a slit, forth and back", "[slice]") {
  const CheckedCut cut = checkedCut(shapes::quad({-1, 0.5, -1}, {0.5, 0.5, -1}, {0.5, 0.5, 2}, {-1, 0.5, 2}), unitGrid(1));
  REQUIRE(cut.mesh.cellCount() == 1);
  const Slice s = checkedSlice(cut.mesh, {{0, 0, 1}, 0.5});
  REQUIRE(s.polygonCount() == 1);
  CHECK(s.loopOffsets.size() == 2);
  std::vector<std::array<uint32_t, 2>> edges;
  for (size_t i = 0; i < s.loopPoints.size(); ++i) edges.push_back({s.loopPoints[i], s.loopPoints[(i + 1) % s.loopPoints.size()]});
  double slit = 0;
  for (const auto& [a, b] : edges) {
    if (std::find(edges.begin(), edges.end(), std::array{b, a}) != edges.end()) slit += std::fabs(s.positions[3 * a] - s.positions[3 * b]);
  }
  CHECK(slit == Approx(2 * 0.5));
}

TEST_CASE("a sheet that closes upon itself within a cell is a hole and an outline", "[slice]") {
  for (const int slices : {3, 5, 8, 9, 17}) {
    const CheckedCut cut = checkedCut(shapes::tube({0.5, 0.5, 0.2}, 0.3, 0.6, slices, false), unitGrid(1));
    REQUIRE(cut.mesh.cellCount() == 1);
    const double inside = 0.5 * slices * 0.3 * 0.3 * std::sin(2 * std::numbers::pi / slices);
    const Plane plane = {{0, 0, 1}, 0.5};
    const Slice s = checkedSlice(cut.mesh, plane);
    REQUIRE(s.polygonCount() == 2);
    std::vector<double> areas = {polygonArea(s, plane.normal, 0), polygonArea(s, plane.normal, 1)};
    std::sort(areas.begin(), areas.end());
    CHECK(areas[0] == Approx(inside));
    CHECK(areas[1] == Approx(1 - inside));
  }
}

TEST_CASE("a plane along a sheet within a cell that rounding has roughened", "[slice]") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const auto noise = [&] { return 0.2 * (double(random()) * 0x1p-32 - 0.5); };
    const auto height = [&] { return random() % 4 == 0 ? (random() % 2 == 0 ? 1.3 : 1.9) : 1.6 + (int(random() % 5) - 2) * 0x1p-52; };
    const Mesh mesh = shapes::sheet(6, 6, [&](int i, int j) {
      const double x = 0.2 + 0.6 * i + noise(), y = 0.2 + 0.6 * j + noise();
      return Point{x, y, height()};
    });
    const CutResult cut = mandoline::cut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {1, 1, 1}));
    REQUIRE(cut);
    const Slice s = checkedSlice(cut.mesh, {{0, 0, 1}, 1.6});
    for (size_t p = 0; p < s.polygonCount(); ++p) CHECK(polygonArea(s, {0, 0, 1}, p) > -1e-12);
  }
}

TEST_CASE("polygons of neighbouring cut-cells share their points", "[slice]") {
  const CheckedCut cut = checkedCut(openShapes(), unitGrid(4));
  const Slice s = checkedSlice(cut.mesh, {{0.3, 0.5, 1}, 3});
  const std::vector<int32_t> untouched = cut.mesh.gridCellRegion();
  std::map<std::array<uint32_t, 2>, int> uses;
  for (size_t p = 0; p < s.polygonCount(); ++p) {
    if (s.polygonCell[p] < 0) continue;
    for (uint32_t l = s.polygonLoopOffsets[p]; l < s.polygonLoopOffsets[p + 1]; ++l) {
      const auto loop = loopOf(s, l);
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
        ++uses[{a, b}];
        --uses[{b, a}];
      }
    }
  }
  size_t open = 0;
  for (const auto& [edge, count] : uses) {
    if (count == 0) continue;
    ++open;  // must lie on a plane of the grid
    const Point a = pointOf(s, edge[0]), b = pointOf(s, edge[1]);
    CHECK(std::any_of(a.begin(), a.end(), [&](const double& x) { return x == b[size_t(&x - a.data())] && x == std::floor(x); }));
  }
  CHECK(open < uses.size() / 2);
}

TEST_CASE("untouched grid cells can be left out", "[slice]") {
  const CheckedCut cut = checkedCut(shapes::cube(1.25, 2.5), unitGrid(4));
  const Plane plane = {{1, 1, 1}, 5.5};
  const Slice all = checkedSlice(cut.mesh, plane), some = slice(cut.mesh, plane, {.untouched = false});
  CHECK(some.polygonCount() == size_t(std::count_if(all.polygonCell.begin(), all.polygonCell.end(), [](int32_t c) { return c >= 0; })));
  CHECK(some.polygonCount() < all.polygonCount());
  CHECK(std::all_of(some.polygonCell.begin(), some.polygonCell.end(), [](int32_t c) { return c >= 0; }));
  CHECK(std::equal(some.loopPoints.begin(), some.loopPoints.end(), all.loopPoints.begin()));
}

TEST_CASE("a plane without a direction is refused, one beside the grid cuts nothing", "[slice]") {
  const CheckedCut cut = checkedCut(shapes::cube(1.25, 2.5), unitGrid(4));
  const double inf = INFINITY, nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const Plane& plane) { return refusal([&] { slice(cut.mesh, plane); }); };
  CHECK(refused({{0, 0, 0}, 1}) == std::pair(Status::badArgument, int64_t(-1)));
  CHECK(refused({{0, nan, 0}, 1}) == std::pair(Status::badArgument, int64_t(1)));
  CHECK(refused({{1, 0, inf}, 1}) == std::pair(Status::badArgument, int64_t(2)));
  CHECK(refused({{1, 0, 0}, nan}) == std::pair(Status::badArgument, int64_t(0)));
  CHECK(refused({{1, 0, 0}, -inf}) == std::pair(Status::badArgument, int64_t(0)));
  const std::vector<double> offsets = {1, 2, nan};
  CHECK(refusal([&] { slices(cut.mesh, {0, 0, 1}, offsets); }) == std::pair(Status::badArgument, int64_t(2)));
  CHECK(refusal([] { slice(CutMesh(), {{1, 0, 0}, 0}); }).first == Status::badArgument);
  CHECK(refusal([] { slices(CutMesh(), {1, 0, 0}, {}); }).first == Status::badArgument);
  for (const Plane& plane : {Plane{{1, 0, 0}, 4.5}, {{1, 0, 0}, 1e300}, {{5e-324, 0, 0}, -1e300}, {{0, 1e300, 0}, 1e308}}) {
    const Slice none = slice(cut.mesh, plane);
    CHECK(none.polygonCount() == 0);
    CHECK(none.positions.empty());
    CHECK(none.loopOffsets == std::vector<uint32_t>{0});
    CHECK(none.polygonLoopOffsets == std::vector<uint32_t>{0});
    CHECK(none.polygonTriangleOffsets == std::vector<uint32_t>{0});
  }
}

TEST_CASE("slices of parallel planes are bit for bit those of single calls, in any order of offsets", "[slice]") {
  for (const bool closed : {true, false}) {
    const CutResult cut = mandoline::cut(closed ? closedShapes() : openShapes(), Grid::box({0, 0, 0}, {4, 4, 4}, {4, 4, 4}));
    REQUIRE(cut);
    std::mt19937 random(11);
    for (const Point& normal : std::vector<Point>{{0, 0, 1}, {0, -2, 0}, {1, 2, 3}, {-0.3, 0.1, 0.01}}) {
      std::vector<double> offsets = {1e9, -1e9, 0, 1, 1, 1, 2};  // beside the grid, on planes, again
      for (int i = 0; i < 40; ++i) offsets.push_back(dot(normal, {2, 2, 2}) + 2 * (double(random()) * 0x1p-31 - 1));
      for (size_t v = 0; v < 20; ++v)
        offsets.push_back(dot(normal, Point{cut.mesh.positions[3 * v], cut.mesh.positions[3 * v + 1], cut.mesh.positions[3 * v + 2]}));
      for (const bool untouched : {true, false}) {
        const std::vector<Slice> all = slices(cut.mesh, normal, offsets, {untouched});
        REQUIRE(all.size() == offsets.size());
        size_t different = 0;
        for (size_t i = 0; i < offsets.size(); ++i) different += !isSame(all[i], slice(cut.mesh, {normal, offsets[i]}, {untouched}));
        CHECK(different == 0);
      }
    }
    CHECK(slices(cut.mesh, {1, 0, 0}, {}).empty());
  }
}

TEST_CASE("a cut-mesh whose cells are not closed is cut somehow", "[slice][locate]") {
  CutMesh mesh = checkedCut(openShapes(), unitGrid(3)).mesh;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    uint32_t* halfFaces = &mesh.cellHalfFaces[mesh.cellHalfFaceOffsets[c]];
    halfFaces[0] = halfFaces[1];
  }
  for (const Plane& plane : randomPlanes({1.5, 1.5, 1.5}, 1.5, 20, 9)) {
    const Slice s = slice(mesh, plane);
    for (const uint32_t p : s.triangles) REQUIRE(3 * size_t(p) < s.positions.size());
    CHECK(cellsAt(mesh, s.positions).cell.size() == s.positions.size() / 3);
  }
}

TEST_CASE("neither the normal's length nor the scale matters", "[slice]") {
  const CheckedCut cut = checkedCut(closedShapes(), unitGrid(4));
  const Plane plane = {{0.25, -0.5, 0.75}, 1};
  const Slice once = checkedSlice(cut.mesh, plane);
  for (const double factor : {0x1p-1000, 0x1p1000}) {
    const Slice again = slice(cut.mesh, {{0.25 * factor, -0.5 * factor, 0.75 * factor}, factor});
    CHECK(again.positions == once.positions);
    CHECK(again.triangles == once.triangles);
  }
  for (const double scale : {0x1p-900, 0x1p900}) {
    const Mesh mesh = shapes::scaled(closedShapes(), {scale, scale, scale});
    const CutResult scaled = mandoline::cut(mesh, Grid::box({0, 0, 0}, {4 * scale, 4 * scale, 4 * scale}, {4, 4, 4}));
    REQUIRE(scaled);
    Slice again = slice(scaled.mesh, {plane.normal, scale});
    for (double& x : again.positions) x /= scale;
    CHECK(again.positions == once.positions);
    CHECK(again.triangles == once.triangles);
  }
}
