// Triangulation of faces: what holds for a face with any coordinates, and what holds for faces that rounding has left intact.
#include "mandoline/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "catch.h"
#include "checked_cut.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

using Edge = std::array<uint32_t, 2>;
using Point = std::array<double, 2>;
using Loops = std::vector<std::vector<uint32_t>>;

/// One face in the plane z = 0.
struct Polygon {
  std::vector<Point> points;
  Loops loops;

  void addLoop(const std::vector<Point>& loop) {
    loops.emplace_back();
    for (const Point& p : loop) {
      loops.back().push_back(uint32_t(points.size()));
      points.push_back(p);
    }
  }
  CutMesh cutMesh() const {
    CutMesh result;
    for (const Point& p : points) result.positions.insert(result.positions.end(), {p[0], p[1], 0.0});
    result.rowRunOffsets = result.loopOffsets = {0};
    for (const auto& loop : loops) {
      result.loopVertices.insert(result.loopVertices.end(), loop.begin(), loop.end());
      result.loopOffsets.push_back(uint32_t(result.loopVertices.size()));
    }
    result.faceLoopOffsets = {0, uint32_t(loops.size())};
    result.faceTriangle = {-1};
    result.faceAxis = {2};
    result.facePlane = {0};
    return result;
  }
  std::vector<uint32_t> triangulate() const { return triangulateFaces(cutMesh()).triangles; }
};

double twiceArea(const Point& a, const Point& b, const Point& c) { return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]); }

double twiceArea(const Polygon& polygon) {
  double sum = 0;
  for (const auto& loop : polygon.loops) {
    for (size_t i = 0; i < loop.size(); ++i)
      sum += twiceArea(polygon.points[loop[0]], polygon.points[loop[i]], polygon.points[loop[(i + 1) % loop.size()]]);
  }
  return sum;
}

std::vector<Edge> edgesOf(const Loops& loops) {
  std::vector<Edge> edges;
  for (const auto& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
  }
  return edges;
}

std::vector<Edge> edgesOf(const std::vector<uint32_t>& triangles) {
  std::vector<Edge> edges;
  for (size_t i = 0; i < triangles.size(); ++i) edges.push_back({triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1]});
  return edges;
}

/// Edges that are left when opposite ones have cancelled.
std::vector<Edge> uncancelled(const std::vector<Edge>& edges) {
  std::vector<std::pair<Edge, int>> signedEdges;
  for (const Edge& e : edges) signedEdges.push_back({{std::min(e[0], e[1]), std::max(e[0], e[1])}, e[0] < e[1] ? 1 : -1});
  std::sort(signedEdges.begin(), signedEdges.end());
  std::vector<Edge> left;
  for (size_t i = 0, j; i < signedEdges.size(); i = j) {
    int sum = 0;
    for (j = i; j < signedEdges.size() && signedEdges[j].first == signedEdges[i].first; ++j) sum += signedEdges[j].second;
    const auto [low, high] = signedEdges[i].first;
    for (; sum > 0; --sum) left.push_back({low, high});
    for (; sum < 0; ++sum) left.push_back({high, low});
  }
  return left;
}

/// Number of connected sets of loops that share vertices.
size_t components(const Polygon& polygon) {
  std::vector<uint32_t> root(polygon.points.size());
  for (uint32_t i = 0; i < root.size(); ++i) root[i] = i;
  const auto find = [&](uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const Edge& e : edgesOf(polygon.loops)) root[find(e[0])] = find(e[1]);
  size_t count = 0;
  for (uint32_t i = 0; i < root.size(); ++i) {
    const auto uses = [i](const auto& loop) { return std::find(loop.begin(), loop.end(), i) != loop.end(); };
    count += find(i) == i && std::any_of(polygon.loops.begin(), polygon.loops.end(), uses);
  }
  return count;
}

/// What holds for any coordinates.
void requireWatertight(const Polygon& polygon, const std::vector<uint32_t>& triangles) {
  bool distinct = true;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    distinct &= triangles[t] != triangles[t + 1] && triangles[t + 1] != triangles[t + 2] && triangles[t + 2] != triangles[t];
  }
  REQUIRE(distinct);
  REQUIRE(uncancelled(edgesOf(triangles)) == uncancelled(edgesOf(polygon.loops)));
}

/// The number of triangles of a face whose inside is connected.
void requireComplete(const Polygon& polygon, const std::vector<uint32_t>& triangles) {
  REQUIRE(triangles.size() / 3 == edgesOf(polygon.loops).size() + 2 * (components(polygon) - 1) - 2);
  std::vector<Edge> made = edgesOf(triangles), given = edgesOf(polygon.loops);
  std::sort(made.begin(), made.end());
  std::sort(given.begin(), given.end());
  REQUIRE(std::adjacent_find(made.begin(), made.end()) == made.end());
  REQUIRE(std::includes(made.begin(), made.end(), given.begin(), given.end()));
}

/// What also holds for a face that does not overlap itself. Areas are exact for small integer coordinates, else good to `relativeError`.
void requireTriangulates(const Polygon& polygon, double relativeError = 0) {
  const std::vector<uint32_t> triangles = polygon.triangulate();
  requireWatertight(polygon, triangles);
  requireComplete(polygon, triangles);
  double least = HUGE_VAL, sum = 0;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    const double area = twiceArea(polygon.points[triangles[t]], polygon.points[triangles[t + 1]], polygon.points[triangles[t + 2]]);
    least = std::min(least, area);
    sum += area;
  }
  CHECK(least > 0);
  CHECK(std::fabs(sum - twiceArea(polygon)) <= relativeError * sum);
}

std::vector<Point> circle(double x, double y, double radius, int n, bool clockwise = false) {
  std::vector<Point> loop;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    loop.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  if (clockwise) std::reverse(loop.begin(), loop.end());
  return loop;
}

/// An edge-connected set of unit squares, the largest in a random pattern, by its boundary: all lattice points on it are vertices. Where
/// two of its squares meet in a corner only, loops run through that vertex several times, or, if `split`, touch each other there.
Polygon randomPolyomino(std::mt19937& random, int size, double density, bool split) {
  std::vector<int> label(size_t(size) * size, -1);
  for (int& l : label) l = std::uniform_real_distribution<>()(random) < density ? 0 : -1;
  int largest = 0, largestCount = 0, labels = 0;
  for (int s = 0; s < size * size; ++s) {
    if (label[s] != 0) continue;
    std::vector<int> stack = {s};
    label[s] = ++labels;
    int count = 0;
    while (!stack.empty()) {
      const int at = stack.back(), x = at % size, y = at / size;
      stack.pop_back();
      ++count;
      for (const auto& [nx, ny] : {Edge{uint32_t(x + 1), uint32_t(y)}, Edge{uint32_t(x - 1), uint32_t(y)},
                                   Edge{uint32_t(x), uint32_t(y + 1)}, Edge{uint32_t(x), uint32_t(y - 1)}}) {
        if (nx >= uint32_t(size) || ny >= uint32_t(size) || label[ny * size + nx] != 0) continue;
        label[ny * size + nx] = labels;
        stack.push_back(int(ny * size + nx));
      }
    }
    if (count > largestCount) {
      largest = labels;
      largestCount = count;
    }
  }
  const auto inside = [&](int x, int y) { return x >= 0 && y >= 0 && x < size && y < size && label[y * size + x] == largest; };
  const int dx[4] = {1, 0, -1, 0}, dy[4] = {0, 1, 0, -1};
  // The edge from lattice point (x, y) in direction d has the square to its left inside and the one to its right outside.
  const auto isBoundary = [&](int x, int y, int d) {
    const int lx = x + (d == 1 || d == 2 ? -1 : 0), ly = y + (d == 2 || d == 3 ? -1 : 0);
    const int rx = x + (d == 2 || d == 3 ? -1 : 0), ry = y + (d == 0 || d == 3 ? -1 : 0);
    return inside(lx, ly) && !inside(rx, ry);
  };
  Polygon polygon;
  for (int y = 0; y <= size; ++y) {
    for (int x = 0; x <= size; ++x) polygon.points.push_back({double(x), double(y)});
  }
  std::vector<bool> done(4 * polygon.points.size());
  for (int start = 0; start < int(done.size()); ++start) {
    int x = start / 4 % (size + 1), y = start / 4 / (size + 1), d = start % 4;
    if (done[start] || !isBoundary(x, y, d)) continue;
    std::vector<uint32_t> loop;
    for (int at = start; !done[at]; at = 4 * (y * (size + 1) + x) + d) {
      done[at] = true;
      loop.push_back(uint32_t(at / 4));
      x += dx[d];
      y += dy[d];
      const int turns[2] = {(d + (split ? 3 : 1)) % 4, (d + (split ? 1 : 3)) % 4};
      d = isBoundary(x, y, turns[0]) ? turns[0] : isBoundary(x, y, d) ? d : turns[1];
    }
    polygon.loops.push_back(loop);
  }
  // The first loop, which starts at the lowest lattice point, is the outer one.
  return polygon;
}

}  // namespace

TEST_CASE("triangulate: convex faces and faces with vertices on straight sides", "[triangulate]") {
  for (int n = 3; n < 40; ++n) {
    Polygon polygon;
    polygon.addLoop(circle(0, 0, 1, n));
    requireTriangulates(polygon, 1e-14);
  }
  for (int onSide = 0; onSide < 6; ++onSide) {
    Polygon polygon;
    std::vector<Point> loop;
    for (int i = 0; i <= onSide; ++i) loop.push_back({double(i), 0});
    for (int i = 0; i <= onSide; ++i) loop.push_back({double(onSide + 1 - i), double(i)});
    loop.push_back({0, double(onSide + 1)});
    polygon.addLoop(loop);
    requireTriangulates(polygon);
  }
}

TEST_CASE("triangulate: concave faces", "[triangulate]") {
  Polygon comb;
  std::vector<Point> loop = {{0, 0}, {200, 0}};
  for (int x = 200; x > 0; x -= 2) loop.insert(loop.end(), {{double(x), 50}, {double(x - 1), 1}});
  loop.push_back({0, 50});
  comb.addLoop(loop);
  requireTriangulates(comb);

  Polygon spiral;
  loop.clear();
  for (int i = 1; i < 300; ++i)
    loop.push_back({std::round(1e4 * (i + 10) * std::cos(0.1 * i)), std::round(1e4 * (i + 10) * std::sin(0.1 * i))});
  for (int i = 299; i > 0; --i) loop.push_back({std::round(1e4 * i * std::cos(0.1 * i)), std::round(1e4 * i * std::sin(0.1 * i))});
  spiral.addLoop(loop);
  requireTriangulates(spiral);
}

TEST_CASE("triangulate: faces with holes", "[triangulate]") {
  Polygon polygon;
  polygon.addLoop({{0, 0}, {100, 0}, {100, 100}, {0, 100}});
  SECTION("one") { polygon.addLoop({{10, 10}, {10, 90}, {90, 90}, {90, 10}}); }
  SECTION("aligned, so that the rays between them graze vertices") {
    for (int x = 10; x < 90; x += 20) {
      for (int y = 10; y < 90; y += 20)
        polygon.addLoop(
            {{double(x), double(y)}, {double(x), double(y + 10)}, {double(x + 10), double(y + 10)}, {double(x + 10), double(y)}});
    }
  }
  SECTION("diamonds") {
    for (int x = 10; x < 90; x += 20) {
      for (int y = 10; y < 90; y += 20)
        polygon.addLoop(
            {{double(x), double(y)}, {double(x + 9), double(y + 9)}, {double(x + 18), double(y)}, {double(x + 9), double(y - 9)}});
    }
  }
  SECTION("a hook around another") {
    polygon.addLoop({{10, 10}, {10, 90}, {90, 90}, {90, 80}, {20, 80}, {20, 10}});
    polygon.addLoop({{30, 30}, {30, 70}, {70, 70}, {70, 30}});
  }
  SECTION("slits") {
    polygon.addLoop({{10, 10}, {20, 10}});
    polygon.addLoop({{30, 10}, {30, 60}});
    polygon.addLoop({{40, 10}, {70, 40}, {60, 90}, {70, 40}});
  }
  requireTriangulates(polygon);
}

TEST_CASE("triangulate: a slit that starts on the outer loop", "[triangulate]") {
  Polygon polygon;
  polygon.points = {{0, 0}, {50, 0}, {100, 0}, {100, 100}, {0, 100}, {50, 50}, {20, 60}};
  polygon.loops = {{0, 1, 5, 6, 5, 1, 2, 3, 4}};
  requireTriangulates(polygon);
}

TEST_CASE("triangulate: holes that touch the outer loop and each other", "[triangulate]") {
  Polygon polygon;
  polygon.points = {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 2}, {2, 4}, {6, 4}, {4, 6}, {3, 3}, {5, 1}, {7, 1}, {1, 5}, {1, 7}};
  SECTION("the outer loop in a corner") { polygon.loops = {{0, 1, 2, 3}, {0, 5, 4}}; }
  SECTION("three holes in one corner of the outer loop") {
    polygon.loops = {{0, 1, 2, 3}, {0, 4, 9}, {0, 11, 5}, {0, 7, 6}};
    if (GENERATE(false, true)) std::swap(polygon.loops[1], polygon.loops[3]);
    if (GENERATE(false, true)) std::swap(polygon.loops[1], polygon.loops[2]);
  }
  SECTION("three holes in one vertex inside") { polygon.loops = {{0, 1, 2, 3}, {8, 10, 9}, {8, 7, 6}, {8, 11, 12}}; }
  SECTION("each other") { polygon.loops = {{0, 1, 2, 3}, {5, 8, 4}, {5, 7, 6}}; }
  SECTION("a hole twice through one vertex") { polygon.loops = {{0, 1, 2, 3}, {5, 8, 4, 5, 7, 6}}; }
  SECTION("a chain from side to side but for one gap") { polygon.loops = {{0, 1, 2, 3}, {0, 5, 4}, {4, 6, 10}, {7, 12, 2}}; }
  requireTriangulates(polygon);
}

TEST_CASE("triangulate: holes that divide a face stay watertight", "[triangulate]") {
  Polygon polygon;
  polygon.points = {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 3}, {3, 4}};
  SECTION("from corner to corner") { polygon.loops = {{0, 1, 2, 3}, {0, 5, 2, 4}}; }
  SECTION("in one loop") { polygon.loops = {{0, 1, 2, 4, 0, 5, 2, 3}}; }
  SECTION("one hole wholly filling it") { polygon.loops = {{0, 1, 2, 3}, {3, 2, 1, 0}}; }
  requireWatertight(polygon, polygon.triangulate());
}

TEST_CASE("triangulate: signs are exact where rounded ones are wrong", "[triangulate]") {
  // Quadrilaterals whose last vertex is on the diagonal but for a few units in the last place (Kettner et al. 2008, "Classroom examples of
  // robustness problems in geometric computations"). Coordinates are integers in units of 2^-53.
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      Polygon polygon;
      polygon.addLoop({{0.50000000000002531 + i * 0x1p-53, 0.5000000000000171 + j * 0x1p-53},
                       {24, 0.5},
                       {24.00000000000005, 24.0000000000000517765},
                       {17.300000000000001, 17.300000000000001}});
      const std::vector<uint32_t> triangles = polygon.triangulate();
      REQUIRE(triangles.size() == 6);
      for (int t = 0; t < 6; t += 3) {
        const auto difference = [&](int k, int axis) {
          return __int128(std::ldexp(polygon.points[triangles[t + k]][axis], 53)) -
                 __int128(std::ldexp(polygon.points[triangles[t]][axis], 53));
        };
        REQUIRE(difference(1, 0) * difference(2, 1) - difference(1, 1) * difference(2, 0) > 0);
      }
    }
  }
}

TEST_CASE("triangulate: random polyominoes, with vertices in several loops and several times in one", "[triangulate]") {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const int size = 2 + i % 9;
    const Polygon polygon = randomPolyomino(random, size, i % 3 == 0 ? 0.6 : 0.85, i % 2 == 0);
    if (!polygon.loops.empty()) requireTriangulates(polygon);
  }
  for (const bool split : {false, true}) {
    const Polygon large = randomPolyomino(random, 60, 0.8, split);
    REQUIRE(large.loops.size() > 50);
    requireTriangulates(large);
  }
}

TEST_CASE("triangulate: random triangular holes, high and narrow or not", "[triangulate]") {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const int columns = 1 + i % 7, rows = 1 + i % 5, width = 6 << i % 3, height = 6 << i % 8;
    const auto within = [&](int size) { return 1 + int(random() % unsigned(size - 1)); };
    Polygon polygon;
    polygon.addLoop({{0, 0}, {double(columns * width), 0}, {double(columns * width), double(rows * height)}, {0, double(rows * height)}});
    for (int c = 0; c < columns * rows; ++c) {
      std::vector<Point> hole;
      for (int k = 0; k < 3; ++k)
        hole.push_back({double(c % columns * width + within(width)), double(c / columns * height + within(height))});
      const double area = twiceArea(hole[0], hole[1], hole[2]);
      if (area > 0) std::swap(hole[1], hole[2]);
      if (area != 0) polygon.addLoop(hole);
    }
    requireTriangulates(polygon);
  }
}

TEST_CASE("triangulate: faces squashed until rounding puts vertices onto each other stay watertight", "[triangulate]") {
  std::mt19937 random(2);
  for (int i = 0; i < 3000; ++i) {
    Polygon polygon = randomPolyomino(random, 2 + i % 7, 0.8, i % 2 == 0);
    const double width = std::ldexp(1.0, -(i % 8) - 48), slope = std::uniform_real_distribution<>(-1, 1)(random);
    for (Point& p : polygon.points) p = {1 + p[0] / 7, 1 + slope * p[0] / 7 + width * p[1]};
    const std::vector<uint32_t> triangles = polygon.triangulate();
    requireWatertight(polygon, triangles);
  }
  for (int i = 0; i < 1000; ++i) {  // all vertices on one line, at one place, or anywhere
    Polygon polygon = randomPolyomino(random, 2 + i % 7, 0.8, i % 2 == 0);
    for (Point& p : polygon.points) {
      if (i % 3 == 0) p[1] = 0;
      if (i % 3 == 1) p = {1, 1};
      if (i % 3 == 2) p = {std::uniform_real_distribution<>()(random), std::uniform_real_distribution<>()(random)};
    }
    requireWatertight(polygon, polygon.triangulate());
  }
}

TEST_CASE("triangulate: a face with thousands of vertices and hundreds of holes", "[triangulate]") {
  Polygon polygon;
  polygon.addLoop(circle(0, 0, 30, 5000));
  for (int x = -20; x <= 20; x += 2) {
    for (int y = -20; y <= 20; y += 2) polygon.addLoop(circle(x + 0.01 * y, y, 0.9, 16, true));
  }
  REQUIRE(polygon.loops.size() == 442);
  requireTriangulates(polygon, 1e-12);
  CHECK(polygon.triangulate() == polygon.triangulate());
}

TEST_CASE("triangulate: a tri-face in space uses the vertices on its sides", "[triangulate]") {
  CutMesh cutMesh;
  cutMesh.rowRunOffsets = {0};
  // (0, 0, 0), (4, 0, 4), (0, 4, 8), with points on the sides; the normal points down in z for the reversed loop.
  const std::vector<Point> points = {{0, 0}, {1, 0}, {2, 0}, {4, 0}, {3, 1}, {2, 2}, {0, 4}, {0, 2}};
  for (const Point& p : points) cutMesh.positions.insert(cutMesh.positions.end(), {p[0], p[1], p[0] + 2 * p[1]});
  cutMesh.loopVertices = {0, 1, 2, 3, 4, 5, 6, 7, 7, 6, 5, 4, 3, 2, 1, 0};
  cutMesh.loopOffsets = {0, 8, 16};
  cutMesh.faceLoopOffsets = {0, 1, 2};
  cutMesh.faceTriangle = {0, 1};
  cutMesh.faceAxis = {-1, -1};
  cutMesh.facePlane = {0, 0};
  const FaceTriangles faces = triangulateFaces(cutMesh);
  REQUIRE(faces.faceTriangleOffsets == std::vector<uint32_t>{0, 6, 12});
  for (uint32_t t = 0; t < 12; ++t) {
    const uint32_t* v = &faces.triangles[3 * t];
    CHECK((t < 6 ? 1 : -1) * twiceArea(points[v[0]], points[v[1]], points[v[2]]) > 0);
  }
  SECTION("and a cell of both sides is closed") {
    cutMesh.cellHalfFaces = {0, 2};
    cutMesh.cellHalfFaceOffsets = {0, 2};
    cutMesh.cellRegion = {0};
    CHECK(uncancelled(edgesOf(triangulateCell(cutMesh, 0))).empty());
    cutMesh.cellHalfFaces = {0, 1};
    CHECK(uncancelled(edgesOf(triangulateCell(cutMesh, 0))).empty());
    cutMesh.cellHalfFaces = {3};
    cutMesh.cellHalfFaceOffsets = {0, 1};
    const std::vector<uint32_t> reversed = triangulateCell(cutMesh, 0);
    REQUIRE(reversed.size() == 18);
    for (size_t t = 0; t < 18; t += 3) CHECK(twiceArea(points[reversed[t]], points[reversed[t + 1]], points[reversed[t + 2]]) > 0);
  }
}

TEST_CASE("triangulate: the triangles of every cell of a cut close it and have its volume", "[triangulate]") {
  Mesh mesh;
  SECTION("a sphere") { mesh = shapes::noisySphere({1.5, 1.5, 1.5}, 1.2, 0.1, 3); }
  SECTION("a torus, with holes in grid-faces") { mesh = shapes::torus({1.5, 1.5, 1.5}, 0.9, 0.3, 31, 17); }
  SECTION("nested tubes along an axis") {
    mesh = shapes::merged({shapes::tube({1.5, 1.5, -1}, 0.4, 5, 24, false), shapes::tube({1.5, 1.5, -1}, 0.3, 5, 24, false),
                           shapes::tube({1.5, 1.5, -1}, 0.2, 5, 24, false)});
  }
  SECTION("a sheet that ends in cells") { mesh = shapes::moebius({1.5, 1.5, 1.5}, 0.9, 0.6, 24); }
  SECTION("coplanar triangles") { mesh = shapes::cube(1, 2); }
  const CutResult result = cut(mesh, unitGrid(3));
  REQUIRE(result.error.message == "");
  const Measures measures = measure(mesh, result.mesh);
  size_t open = 0;
  double worst = 0;
  for (size_t c = 0; c < result.mesh.cellCount(); ++c) {
    Mesh cell;
    cell.positions = result.mesh.positions;
    cell.triangles = triangulateCell(result.mesh, c);
    open += !uncancelled(edgesOf(cell.triangles)).empty();
    worst = std::max(worst, std::fabs(shapes::signedVolume(cell) - measures.cellVolume[c]));
  }
  CHECK(open == 0);
  CHECK(worst < 1e-13);
}

TEST_CASE("a region's surface is closed around it", "[triangulate]") {
  const Mesh mesh = shapes::icosphere({1.5, 1.5, 1.5}, 1.25, 2);
  const CheckedCut cut = checkedCut(mesh, unitGrid(3));
  REQUIRE(cut.mesh.regionCount == 2);
  for (uint32_t region = 0; region < 2; ++region) {
    const int inside = cut.mesh.regionWinding[region];
    Mesh surface = {cut.mesh.positions, triangulateRegion(cut.mesh, region)};
    CHECK(uncancelled(edgesOf(surface.triangles)).empty());
    CHECK(shapes::signedVolume(surface) == Approx((inside == 1 ? 1 : -1) * shapes::signedVolume(mesh)).epsilon(1e-12));
    CHECK(shapes::area(surface) == Approx(shapes::area(mesh)).epsilon(1e-12));
  }
}

TEST_CASE("a region has both sides of a sheet that ends within it", "[triangulate]") {
  const Mesh mesh = shapes::quad({0.25, 0.5, 0.25}, {1.75, 0.5, 0.25}, {1.75, 0.5, 1.5}, {0.25, 0.5, 1.5});
  const CheckedCut cut = checkedCut(mesh, unitGrid(2));
  REQUIRE(cut.mesh.regionCount == 1);
  const Mesh surface = {cut.mesh.positions, triangulateRegion(cut.mesh, 0)};
  CHECK(uncancelled(edgesOf(surface.triangles)).empty());
  CHECK(shapes::area(surface) == Approx(2 * shapes::area(mesh)).epsilon(1e-12));
}

TEST_CASE("the triangles of a cell and of a region are those of all faces, turned to it", "[triangulate]") {
  const Mesh mesh = shapes::merged({shapes::torus({1.5, 1.5, 1.5}, 0.9, 0.3, 31, 17), shapes::moebius({1.5, 1.5, 1.4}, 0.3, 0.2, 12)});
  const CheckedCut cut = checkedCut(mesh, unitGrid(3));
  const FaceTriangles faces = triangulateFaces(cut.mesh);
  std::vector<std::vector<uint32_t>> regions(cut.mesh.regionCount);
  for (size_t c = 0; c < cut.mesh.cellCount(); ++c) {
    std::vector<uint32_t> cell;
    for (const uint32_t h : cut.mesh.halfFaces(c)) {
      for (uint32_t t = faces.faceTriangleOffsets[h / 2]; t < faces.faceTriangleOffsets[h / 2 + 1]; ++t) {
        std::array<uint32_t, 3> v = {faces.triangles[3 * t], faces.triangles[3 * t + 1], faces.triangles[3 * t + 2]};
        if (h % 2 == 1) std::swap(v[1], v[2]);
        cell.insert(cell.end(), v.begin(), v.end());
        std::vector<uint32_t>& region = regions[cut.mesh.cellRegion[c]];
        if (cut.mesh.faceTriangle[h / 2] >= 0) region.insert(region.end(), v.begin(), v.end());
      }
    }
    REQUIRE(triangulateCell(cut.mesh, c) == cell);
  }
  for (uint32_t r = 0; r < cut.mesh.regionCount; ++r) CHECK(triangulateRegion(cut.mesh, r) == regions[r]);
}

TEST_CASE("cells and regions that do not exist can't be triangulated", "[triangulate]") {
  const CheckedCut cut = checkedCut(shapes::cube(0.5, 1.5), unitGrid(2));
  const size_t cells = cut.mesh.cellCount();
  const auto cell = [&](size_t c) { triangulateCell(cut.mesh, c); };
  const auto region = [&](uint32_t r) { triangulateRegion(cut.mesh, r); };
  for (const size_t c : {cells, size_t(99999999), SIZE_MAX}) CHECK(refusal([&] { cell(c); }) == std::pair(Status::badArgument, int64_t(c)));
  for (const uint32_t r : {2u, UINT32_MAX}) CHECK(refusal([&] { region(r); }) == std::pair(Status::badArgument, int64_t(r)));
  CHECK_NOTHROW(cell(cells - 1));
  CHECK_NOTHROW(region(1));
  CHECK(refusal([] { triangulateFaces(CutMesh()); }).first == Status::badArgument);
  CHECK(refusal([] { triangulateCell(CutMesh(), 0); }).first == Status::badArgument);
  CHECK(refusal([] { triangulateRegion(CutMesh(), 0); }).first == Status::badArgument);
}
