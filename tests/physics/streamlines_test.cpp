// Streamlines: none meets a triangle, none leaves the grid but through its sides; velocities at points.
#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

#include "base/exact.h"
#include "case_list.h"
#include "checked_cut.h"
#include "complexes.h"
#include "mandoline/flow.h"
#include "physics/obstacles.h"
#include "refusal.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;

namespace {

using Point = std::array<double, 3>;

/// A mesh in a grid, and a wind about it.
struct Tunnel {
  Mesh mesh;
  CutMesh cutMesh;
  CellComplex cells;
  Flow flow;

  FlowField field() const { return {mesh, cutMesh, cells, flow}; }
};

Tunnel tunnel(const Mesh& mesh, const Grid& grid, const Point& wind, int maxLevel = 0, double snapTolerance = 0) {
  CutOptions cutting;
  cutting.snapTolerance = snapTolerance;
  const CutResult result = cut(mesh, grid, cutting);
  REQUIRE(result);
  CoarsenOptions options;
  options.maxLevel = maxLevel;
  Tunnel t{mesh, result.mesh, cellComplex(mesh, result.mesh, coarsen(result.mesh, options)), {}};
  FlowOptions solving;
  solving.tolerance = 1e-13;
  t.flow = solveFlow(t.cells, wind, solving);
  REQUIRE(t.flow.status == SolveStatus::converged);
  return t;
}

/// Whether a segment crosses a triangle: its ends are on two sides, and its line passes within the three edges or through them.
bool crosses(const Point& p, const Point& q, const Mesh& mesh, size_t t, detail::Predicates& exact) {
  Point c[3];
  for (size_t i = 0; i < 3; ++i) c[i] = vectors::pointAt(mesh.positions, mesh.triangles[3 * t + i]);
  for (size_t d = 0; d < 3; ++d) {
    if (std::max({c[0][d], c[1][d], c[2][d]}) < std::min(p[d], q[d]) || std::min({c[0][d], c[1][d], c[2][d]}) > std::max(p[d], q[d]))
      return false;
  }
  const int from = exact.orient3d(c[0].data(), c[1].data(), c[2].data(), p.data());
  const int to = exact.orient3d(c[0].data(), c[1].data(), c[2].data(), q.data());
  if (from * to > 0 || (from == 0 && to == 0)) return false;
  int turns[3];
  for (size_t i = 0; i < 3; ++i) turns[i] = exact.orient3d(p.data(), q.data(), c[i].data(), c[(i + 1) % 3].data());
  return *std::min_element(turns, turns + 3) >= 0 || *std::max_element(turns, turns + 3) <= 0;
}

bool isOnSide(const Grid& grid, const Point& p) {
  for (size_t d = 0; d < 3; ++d) {
    if (p[d] == grid.planes[d].front() || p[d] == grid.planes[d].back()) return true;
  }
  return false;
}

/// Requires that no segment crosses a triangle, that all points lie in the grid, and that ends are what they say. How many end so.
std::array<size_t, 6> checkLines(const Tunnel& t, const Streamlines& lines, size_t seeds) {
  REQUIRE(lines.ends.size() == seeds);
  REQUIRE(lines.offsets.size() == seeds + 1);
  REQUIRE(lines.offsets.back() == lines.speeds.size());
  REQUIRE(lines.points.size() == 3 * lines.speeds.size());
  detail::Predicates exact;
  size_t crossings = 0, strays = 0;
  std::array<size_t, 6> counts{};
  for (size_t l = 0; l < seeds; ++l) {
    ++counts[size_t(lines.ends[l])];
    for (uint32_t i = lines.offsets[l]; i < lines.offsets[l + 1]; ++i) {
      const Point p = vectors::pointAt(lines.points, i);
      for (size_t d = 0; d < 3; ++d) strays += !(p[d] >= t.cutMesh.grid.planes[d].front() && p[d] <= t.cutMesh.grid.planes[d].back());
      if (i + 1 == lines.offsets[l + 1]) {
        if (lines.ends[l] == StreamlineEnd::side) strays += !isOnSide(t.cutMesh.grid, p);
        continue;
      }
      for (size_t f = 0; f < t.mesh.triangleCount(); ++f) crossings += crosses(p, vectors::pointAt(lines.points, i + 1), t.mesh, f, exact);
    }
  }
  CHECK(crossings == 0);
  CHECK(strays == 0);
  return counts;
}

Mesh plate() { return shapes::quad({1.5, 1.5, 2.5}, {4.5, 1.5, 2.5}, {4.5, 4.5, 2.5}, {1.5, 4.5, 2.5}); }

/// n x n seeds in the plane z, from 0.05 to size - 0.05.
std::vector<double> seedsIn(double z, int n, double size) {
  std::vector<double> seeds;
  for (int i = 0; i < n * n; ++i) {
    for (const int k : {i % n, i / n}) seeds.push_back(0.05 + (size - 0.1) * k / (n - 1));
    seeds.push_back(z);
  }
  return seeds;
}

}  // namespace

TEST_CASE("velocityAt: what blows through an empty box blows everywhere; NaN outside", "[streamlines]") {
  const Tunnel t = tunnel(shapes::cube(100, 101), unitGrid(8, 6, 7), {0.75, -1.25, 0.5}, 24);
  const std::vector<double> points = {0, 0, 0, 8, 6, 7, 3.3, 2.2, 1.1, 4, 3, 2, 9, 1, 1, NAN, 1, 1};
  const std::vector<double> v = velocityAt(t.field(), points);
  for (size_t i = 0; i < 4; ++i) {
    CHECK(v[3 * i] == Approx(0.75));
    CHECK(v[3 * i + 1] == Approx(-1.25));
    CHECK(v[3 * i + 2] == Approx(0.5));
  }
  for (size_t i = 12; i < 18; ++i) CHECK(std::isnan(v[i]));
}

TEST_CASE("velocityAt: the two sides of a plate don't mix", "[streamlines]") {
  const Tunnel t = tunnel(plate(), unitGrid(6), {0.5, 0, 1});
  const std::vector<double> v = velocityAt(t.field(), std::vector<double>{3.9, 3, 2.4999, 3.9, 3, 2.5001});
  CHECK(v[0] - v[3] >= 0.5);  // to the rim on the side that it blows at, back from it behind
  CHECK(std::fabs(v[2]) + std::fabs(v[5]) <= 0.2);
}

TEST_CASE("streamlines: straight through an empty box, both ways, from its lower side to its upper one", "[streamlines]") {
  const Tunnel t = tunnel(shapes::cube(100, 101), unitGrid(8, 6, 7), {0.5, 0, 1}, 24);
  const std::vector<double> seeds = {1, 2.5, 0, 2.25, 3, 3.5, 4, 4, 7.5};
  const Streamlines down = streamlines(t.field(), seeds);
  CHECK(checkLines(t, down, 3) == std::array<size_t, 6>{2, 0, 0, 0, 0, 1});
  const Point end = vectors::pointAt(down.points, down.offsets[1] - 1), other = vectors::pointAt(down.points, down.offsets[2] - 1);
  CHECK(vectors::length(vectors::operator-(end, Point{4.5, 2.5, 7})) <= 1e-9);
  CHECK(vectors::length(vectors::operator-(other, Point{4, 3, 7})) <= 1e-9);
  StreamlineOptions options;
  options.upstream = true;
  const Streamlines up = streamlines(t.field(), seeds, options);
  CHECK(vectors::length(vectors::operator-(vectors::pointAt(up.points, up.offsets[2] - 1), Point{0.5, 3, 0})) <= 1e-9);
  options.maxLength = 1.5;
  const Streamlines few = streamlines(t.field(), seeds, options);
  CHECK(few.ends[1] == StreamlineEnd::maxLength);
  CHECK(vectors::length(vectors::operator-(vectors::pointAt(few.points, few.offsets[2] - 1), Point{2.25, 3, 3.5})) == Approx(1.5));
  options.maxPoints = 2;
  options.maxLength = 100;
  CHECK(streamlines(t.field(), seeds, options).ends[1] == StreamlineEnd::maxPoints);
}

TEST_CASE("streamlines: round a plate, never through it, also along it and ending at it", "[streamlines]") {
  const Tunnel broadside = tunnel(plate(), unitGrid(6), {0.1, 0, 1});
  const auto counts = checkLines(broadside, streamlines(broadside.field(), seedsIn(0, 24, 6)), 576);
  CHECK(counts[0] + counts[1] == 576);
  CHECK(counts[0] >= 400);
  const Tunnel edgeOn = tunnel(plate(), unitGrid(6), {1, 0, 0});
  const std::vector<double> seeds = {0.5, 3, 2.5000001, 3, 3, 2.5};  // beside it, on it
  const Streamlines lines = streamlines(edgeOn.field(), seeds);
  checkLines(edgeOn, lines, 2);
  CHECK(lines.ends == std::vector<StreamlineEnd>{StreamlineEnd::side, StreamlineEnd::surface});
  CHECK(lines.offsets[2] - lines.offsets[1] == 1);
}

TEST_CASE("streamlines: where segments meet a triangle, its borders and its plane included", "[streamlines]") {
  const Mesh mesh = shapes::triangle({1, 1, 2}, {3, 1, 2}, {1, 3, 2});
  const physics::Obstacles obstacles(mesh, unitGrid(4));
  detail::Predicates exact;
  const auto isFree = [&](const Point& p, const Point& q) { return obstacles.isFree({p, q}, exact); };
  CHECK_FALSE(isFree({1.5, 1.5, 1}, {1.5, 1.5, 3}));
  CHECK(isFree({1.5, 1.5, 1}, {1.5, 1.5, std::nextafter(2, 0)}));
  CHECK_FALSE(isFree({1.5, 1.5, 1}, {1.5, 1.5, 2}));  // ends in it
  CHECK_FALSE(isFree({2, 2, 1}, {2, 2, 3}));          // through a side
  CHECK_FALSE(isFree({1, 3, 1}, {1, 3, 3}));          // through a corner
  CHECK(isFree({2, std::nextafter(2, 3), 1}, {2, 2.5, 3}));
  CHECK_FALSE(isFree({0, 2, 2}, {4, 2, 2}));  // in its plane
  CHECK_FALSE(isFree({1.5, 1.5, 2}, {1.75, 1.5, 2}));
  CHECK_FALSE(isFree({0, 1, 2}, {1, 1, 2}));
  CHECK(isFree({0, 1, 2}, {std::nextafter(1, 0), 1, 2}));
  CHECK(isFree({2, 2.5, 2}, {2.5, 2, 2}));
  const Point last = obstacles.reached({{1.5, 1.25, 0.5}, {1.5, 1.5, 3.7}}, exact);
  CHECK(last[2] < 2);
  CHECK(last[2] >= 2 - 1e-15);
  CHECK(obstacles.reached({{1.5, 1.5, 2}, {1.5, 1.5, 3}}, exact) == Point{1.5, 1.5, 2});
}

TEST_CASE("streamlines: none through a triangle in all cases, single grid cells and octree cells", "[streamlines]") {
  for (const NamedCase& c : caseList()) {
    for (const int maxLevel : {0, 24}) {
      CAPTURE(c.name, maxLevel);
      const Point wind = {0.4, -0.3, 1};
      const Tunnel t = tunnel(c.mesh, c.grid, wind, maxLevel);
      std::vector<double> seeds = inflowSeeds(c.grid, wind, 40);
      for (size_t i = 0; i < t.cells.cellCount() && seeds.size() < 200; i += 1 + t.cells.cellCount() / 25)
        seeds.insert(seeds.end(), &t.cells.cellCentroid[3 * i], &t.cells.cellCentroid[3 * i] + 3);
      const auto counts = checkLines(t, streamlines(t.field(), seeds), seeds.size() / 3);
      CHECK(counts[4] == 0);  // none wanders about for ever
      CHECK(counts[5] == 0);
    }
  }
}

TEST_CASE("streamlines: a closed ball lets none in; most go round it", "[streamlines]") {
  const Tunnel t = tunnel(shapes::icosphere({3.5, 3.5, 3.5}, 1.5, 2), unitGrid(7), {0, 0, 1});
  const Streamlines lines = streamlines(t.field(), seedsIn(0, 16, 7));
  const auto counts = checkLines(t, lines, 256);
  CHECK(counts[0] >= 230);
  const Streamlines inside = streamlines(t.field(), std::vector<double>{3.5, 3.5, 3.5});
  CHECK(inside.ends[0] == StreamlineEnd::rest);
}

TEST_CASE("streamlines: seeds on the sides that the wind enters by", "[streamlines]") {
  const Grid grid = unitGrid(8, 6, 7);
  const std::vector<double> seeds = inflowSeeds(grid, {1, -0.5, 0}, 100);
  REQUIRE(seeds.size() == 300);
  size_t onX = 0;
  for (size_t i = 0; i < 100; ++i) {
    onX += seeds[3 * i] == 0;
    CHECK((seeds[3 * i] == 0 || seeds[3 * i + 1] == 6));
    for (size_t d = 0; d < 3; ++d) CHECK((seeds[3 * i + d] >= 0 && seeds[3 * i + d] <= grid.planes[d].back()));
  }
  CHECK(std::abs(int(onX) - 60) <= 3);  // 42 : 28
  CHECK(inflowSeeds(grid, {0, 0, 0}, 3).empty());
  CHECK(refusal([&] { inflowSeeds(grid, {1, NAN, 0}, 3); }).first == Status::badArgument);
  CHECK(refusal([&] { inflowSeeds(Grid::box({0, 0, 0}, {1, 1, 1}, {1, 1, 0}), {1, 0, 0}, 3); }).first == Status::badGrid);
}

TEST_CASE("streamlines: a line that goes round in circles ends", "[streamlines]") {
  // Four cells about the line x = y = 2, each of one velocity, which leads to the next one and a little inward.
  Tunnel t = tunnel(shapes::cube(100, 101), Grid::box({0, 0, 0}, {4, 4, 4}, {2, 2, 1}), {1, 0, 0});
  REQUIRE(t.cells.cellCount() == 4);
  std::fill(t.flow.cellGradient.begin(), t.flow.cellGradient.end(), 0.0);
  for (size_t c = 0; c < 4; ++c) {
    const double x = t.cells.cellCentre[3 * c] - 2, y = t.cells.cellCentre[3 * c + 1] - 2;
    const Point round = {-y, x, 0};
    for (size_t d = 0; d < 3; ++d) t.flow.cellVelocity[3 * c + d] = round[d] - (d < 2 ? 1e-5 * (d == 0 ? x : y) : 0);
  }
  const Streamlines lines = streamlines(t.field(), std::vector<double>{1.5, 1.2, 1});
  CHECK(lines.ends[0] == StreamlineEnd::rest);
  CHECK(lines.speeds.size() < 300);
}

TEST_CASE("streamlines: cells of elsewhere and flows that are not finite are refused; those beyond doubles end lines", "[streamlines]") {
  Tunnel t = tunnel(shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 1), unitGrid(7), {0.2, 0, 1}, 24);
  const std::vector<double> seeds = seedsIn(0.5, 8, 7);
  const auto status = [&] { return refusal([&] { streamlines(t.field(), seeds); }).first; };
  for (const int32_t corner : {-1, 7}) {
    const int32_t old = std::exchange(t.cells.cellCorner[4], corner);
    CHECK(status() == Status::badArgument);
    t.cells.cellCorner[4] = old;
  }
  const Flow flow = t.flow;
  t.flow.cellVelocity[5] = INFINITY;
  CHECK(status() == Status::badArgument);
  t.flow = flow;
  t.flow.cellGradient.back() = NAN;
  CHECK(status() == Status::badArgument);
  t.flow = flow;
  for (size_t i = 0; i < t.flow.cellGradient.size(); i += 7) t.flow.cellGradient[i] = i % 2 ? 1e308 : -1.7e308;
  checkLines(t, streamlines(t.field(), seeds), 64);
}

TEST_CASE("streamlines: cells of another cut, and a part of the cells, are refused", "[streamlines]") {
  const Mesh ball = shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 1);
  const Grid away = Grid::regular({2, 0, 0}, {1, 1, 1}, {7, 7, 7});
  const Tunnel here = tunnel(ball, unitGrid(7), {1, 0, 0}, 24), there = tunnel(shapes::translated(ball, {2, 0, 0}), away, {1, 0, 0}, 24);
  REQUIRE(here.cells.cellCount() == there.cells.cellCount());
  const std::vector<double> point{0.5, 0.5, 0.5};
  const auto requireRefused = [&](const CellComplex& cells, const Flow& flow) {
    const FlowField field{here.mesh, here.cutMesh, cells, flow};
    CHECK(refusal([&] { velocityAt(field, point); }).first == Status::badArgument);
    CHECK(refusal([&] { streamlines(field, point); }).first == Status::badArgument);
  };
  requireRefused(there.cells, there.flow);
  std::vector<uint32_t> most(here.cells.cellCount() - 1);  // all but the last octree cell
  std::iota(most.begin(), most.end(), 0u);
  const CellComplex part = subComplex(here.cells, most).cells;
  REQUIRE(part.cutFaces == here.cells.cutFaces);
  requireRefused(part, solveFlow(part, {1, 0, 0}));
}

TEST_CASE("streamlines: the flow of other cells is refused", "[streamlines]") {
  const Tunnel t = tunnel(shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 1), unitGrid(7), {1, 0, 0});
  CellComplex other = t.cells;
  other.fingerprint.value ^= 1;
  const Flow flow = solveFlow(other, {1, 0, 0});
  const std::vector<double> point{0.5, 0.5, 0.5};
  try {
    velocityAt({t.mesh, t.cutMesh, t.cells, flow}, point);
    FAIL("not refused");
  } catch (const CallError& error) {
    CHECK(error.error.message == "The flow is one of other cells.");
  }
}

TEST_CASE("streamlines: about a snapped mesh as about one that was moved by hand", "[streamlines]") {
  const Mesh ball = shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2);
  const double tolerance = 0.3;
  Mesh moved = ball;
  for (double& x : moved.positions) x = std::fabs(x - std::round(x)) <= tolerance ? std::round(x) : x;
  const Tunnel snapped = tunnel(ball, unitGrid(7), {0.2, 0, 1}, 0, tolerance), byHand = tunnel(moved, unitGrid(7), {0.2, 0, 1});
  CHECK(snapped.cells.cellVolume == byHand.cells.cellVolume);
  const std::vector<double> seeds = seedsIn(0.5, 12, 7);
  const Streamlines lines = streamlines(snapped.field(), seeds);
  CHECK(lines.points == streamlines(byHand.field(), seeds).points);
  checkLines(byHand, lines, 144);
}

TEST_CASE("streamlines: damaged cells lead no line astray", "[streamlines]") {
  const Mesh ball = shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 1);
  const Tunnel coarse = tunnel(ball, unitGrid(7), {0.2, 0, 1}, 24), fine = tunnel(ball, unitGrid(7), {0.2, 0, 1});
  const std::vector<double> seeds = seedsIn(0.5, 5, 7);
  std::mt19937 random(1);
  const auto damage = [&](auto& array) {
    for (int i = 0; i < 20; ++i) array[random() % array.size()] = array[random() % array.size()];
  };
  int harmless = 0;
  for (int round = 0; round < 60; ++round) {
    Tunnel damaged = round % 2 ? coarse : fine;
    if (round % 3 == 0) damage(damaged.cells.cellCorner);
    if (round % 3 == 1) damage(damaged.cells.cellLevel);
    if (round % 3 == 2) damage(damaged.cells.faceTag);
    const auto [found, message] = refusal([&] { checkLines(damaged, streamlines(damaged.field(), seeds), 25); });
    if (found == Status::ok) ++harmless;
  }
  CHECK(harmless > 25);
}

TEST_CASE("streamlines: the same bits for any number of threads; cancelling and wrong calls", "[streamlines]") {
  const Tunnel t = tunnel(shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2), unitGrid(7), {0.2, 0, 1});
  const std::vector<double> seeds = seedsIn(0, 10, 7);
  StreamlineOptions options;
  options.threads = 1;
  const Streamlines one = streamlines(t.field(), seeds, options);
  options.threads = 3;
  const Streamlines three = streamlines(t.field(), seeds, options);
  CHECK(one.points == three.points);
  CHECK(one.offsets == three.offsets);
  CHECK(one.ends == three.ends);
  options.progress = [](const Progress& p) { return p.done == 0; };
  CHECK(refusal([&] { streamlines(t.field(), seeds, options); }).first == Status::cancelled);
  options = {};
  options.tolerance = 0;
  CHECK(refusal([&] { streamlines(t.field(), seeds, options); }).first == Status::badOption);
  options = {}, options.maxLength = -1;
  CHECK(refusal([&] { streamlines(t.field(), seeds, options); }).first == Status::badOption);
  CHECK(refusal([&] { velocityAt(t.field(), std::vector<double>{1, 2}); }).first == Status::badArgument);
  const CellComplex part = regionComplex(t.cells, 0).cells;
  const Flow flow = solveFlow(part, {1, 0, 0});
  CHECK(refusal([&] { velocityAt({t.mesh, t.cutMesh, part, flow}, seeds); }).first == Status::badArgument);
  CHECK(refusal([&] { velocityAt({t.mesh, t.cutMesh, t.cells, flow}, seeds); }).first == Status::badArgument);
}
