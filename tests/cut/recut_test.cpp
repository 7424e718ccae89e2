#include "mandoline/recut.h"

#include "case_list.h"
#include "catch.h"
#include "moving_mesh.h"
#include "seam_meshes.h"

using namespace mandoline;

namespace {

void checkMoving(const Mesh& mesh, const Grid& grid, uint32_t seed, size_t* kept = nullptr) {
  CutOptions options;
  options.threads = 1 + seed % 3;
  options.snapTolerance = seed % 5 == 4 ? 0.125 : 0;
  if (seed % 7 == 6) options.intersections = Intersections::refuse;
  CAPTURE(seed, mesh.triangleCount());
  CHECK(brokenRecut(movingMesh(mesh, seed, seed % 2 == 0 ? 0.25 : 0.0625), grid, options, kept) == "");
}

Mesh ball() { return shapes::icosphere({4.1, 4.2, 3.9}, 3, 4); }

void checkAll(const std::vector<NamedCase>& cases) {
  uint32_t seed = 0;
  for (const NamedCase& one : cases) {
    CAPTURE(one.name);
    checkMoving(one.mesh, one.grid, seed++);
  }
}

}  // namespace

TEST_CASE("recut: any mesh that moves is cut as it would be anew", "[recut]") { checkAll(caseList()); }

TEST_CASE("recut: any soup that moves is cut as it would be anew", "[recut][soups]") { checkAll(casesAndSoups()); }

TEST_CASE("recut: bricks are kept where what is hard lies on their seams", "[recut]") {
  size_t kept = 0;
  for (const Mesh& mesh : seamMeshes()) {
    for (const uint32_t seed : {0u, 1u}) checkMoving(mesh, seamGrid(), seed, &kept);
  }
  CHECK(kept > 0);
}

TEST_CASE("recut: a vertex that moves leaves most bricks as they were", "[recut]") {
  Mesh mesh = ball();
  const Grid grid = Grid::around(mesh, 64);
  Recutter recutter(grid);
  REQUIRE(recutter.cut(mesh));
  CHECK(recutter.counts().kept == 0);
  mesh.positions[0] += 0.01;
  const CutResult again = recutter.cut(mesh);
  REQUIRE(again);
  CHECK(recutter.counts().bricks > 30);
  CHECK(recutter.counts().kept + 8 >= recutter.counts().bricks);
  CHECK(differences(again.mesh, cut(mesh, grid).mesh) == std::vector<std::string>());
}

TEST_CASE("recut: a ball that passes through another one is cut as it would be anew", "[recut]") {
  const Mesh still = ball(), apart = shapes::merged({still, shapes::translated(still, {6, 1, 0})});
  const Grid grid = Grid::around(apart, 32);
  std::vector<Mesh> times;
  for (int t = 0; t < 8; ++t) times.push_back(shapes::merged({still, shapes::translated(still, {6.5 - t * 0.25, 1, 0.0625 * t})}));
  REQUIRE(cut(times.front(), grid).mesh.madeVertices.empty());
  REQUIRE(!cut(times.back(), grid).mesh.madeVertices.empty());
  size_t kept = 0;
  CHECK(brokenRecut(times, grid, {}, &kept) == "");
  CHECK(kept > 0);
}

TEST_CASE("recut: vertices that rounding puts onto each other stay apart where others move", "[recut]") {
  // Two edges from one vertex that cross the plane x = 1 next to each other, far from the origin.
  const double far = 0x1p40, step = 0x1p-12;
  const Grid grid = Grid::regular({far, far, far}, {1, 1, 1}, {24, 24, 24});
  const Mesh near = shapes::triangle({far + 1 - step, far + 1.5, far + 1.5}, {far + 2.5, far + 1.5 + step, far + 1.5},
                                     {far + 2.5, far + 1.5, far + 1.5 + step});
  std::vector<Mesh> times;
  for (const double move : {0.0, 0.5, 0.25}) {
    times.push_back(shapes::merged(
        {near, shapes::triangle({far + 12, far + 12, far + 12 + move}, {far + 19, far + 12.5, far + 12}, {far + 12, far + 20, far + 13})}));
  }
  times.push_back(times.back());
  times.back().positions[4] += step;  // then one of the near ones
  times.push_back(times.front());
  size_t kept = 0;
  CHECK(brokenRecut(times, grid, {}, &kept) == "");
  CHECK(kept > 0);
}

TEST_CASE("recut: a vertex on a seam keeps others away that rounding puts onto it in a brick that is cut again", "[recut]") {
  // Bricks of 4 grid cells. A corner touches the seam x = 4 from below, an edge crosses it next to that.
  const double far = 0x1p40, step = 0x1p-12;
  const auto at = [&](double x, double y, double z) { return std::array<double, 3>{far + x, far + y, far + z}; };
  const Mesh touching = shapes::triangle(at(4, 1.5, 1.5), at(2.5, 0.5, 1.5), at(2.5, 0.5, 1)),
             crossing = shapes::triangle(at(4 - step, 1.5, 1.5), at(5.5, 1.5 + step, 1.5), at(5.5, 2.5, 2));
  std::vector<Mesh> times;
  for (const double move : {0.0, 0.125, 0.25})
    times.push_back(
        shapes::merged({touching, crossing, shapes::triangle(at(6.25, 3.25, 3.25), at(6.75, 3.25, 3.25), at(6.5, 3.25, 3.5 + move))}));
  size_t kept = 0;
  CHECK(brokenRecut(times, Grid::regular({far, far, far}, {1, 1, 1}, {24, 24, 24}), {}, &kept) == "");
  CHECK(kept > 0);
}

TEST_CASE("recut: a brick is kept while one beside it becomes touched, and untouched again", "[recut]") {
  // Bricks of 4 grid cells. The cells of both triangles share a grid-face on the seam x = 4 while they are next to each other.
  const auto at = [](double x) { return shapes::triangle({x + 0.25, 1.25, 1.25}, {x + 0.75, 1.25, 1.25}, {x + 0.5, 1.75, 1.5}); };
  const Grid grid = Grid::regular({0, 0, 0}, {1, 1, 1}, {24, 24, 24});
  for (const auto& [still, beside] : {std::pair(3.0, 4.0), std::pair(4.0, 3.0)}) {
    std::vector<Mesh> times;
    for (const double x : {17.0, beside, 17.0}) times.push_back(shapes::merged({at(still), at(x)}));
    size_t kept = 0;
    CHECK(brokenRecut(times, grid, {}, &kept) == "");
    CHECK(kept == 2);
  }
}

TEST_CASE("recut: vertices that come to lie on others, which rest or move, too, are welded to them, and apart again", "[recut]") {
  using Position = std::array<double, 3>;
  const Position rests{2.75, 1.25, 1.5}, low{4.25, 2.5, 2.5}, high{4.25, 2.5, 4.25}, between{4.5, 2.5, 3.25};
  std::vector<Mesh> times;
  for (const auto& [p, q] :
       {std::pair(low, high), {rests, high}, {low, high}, {between, between}, {low, high}, {rests, rests}, {low, high}})
    times.push_back(
        shapes::merged({shapes::triangle({1.25, 1.25, 1.25}, rests, {1.5, 2.75, 1.25}),
                        shapes::triangle(p, {5.5, 1.5, 1.5}, {5.5, 3.5, 1.5}), shapes::triangle(q, {5.5, 1.5, 4.5}, {5.5, 3.5, 4.5})}));
  CHECK(cut(times[1], Grid::regular({0, 0, 0}, {1, 1, 1}, {8, 8, 8})).stats.weldedVertices == 1);
  CHECK(brokenRecut(times, Grid::regular({0, 0, 0}, {1, 1, 1}, {8, 8, 8})) == "");
}

TEST_CASE("recut: coordinates that become -0, or others that scaling flushes, are handed back as they are", "[recut]") {
  std::vector<Mesh> times;
  for (const double y : {1e-70, 1e-71, 0.0, -0.0, 1e-70})
    times.push_back(shapes::triangle({0.5, y, 0.5}, {1.75, 0.5, 0.5}, {0.5, 1.75, 0.5}));
  for (const double lowest : {0.0, -1.0}) CHECK(brokenRecut(times, Grid::regular({lowest, lowest, lowest}, {1, 1, 1}, {4, 4, 4})) == "");
}

TEST_CASE("recut: after an error, and after a cut that was cancelled, all is cut anew", "[recut]") {
  const Mesh mesh = ball();
  Mesh bad = mesh;
  bad.positions[1] = NAN;
  bool isCancelled = false;
  CutOptions options;
  options.progress = [&](const Progress& progress) { return !isCancelled || progress.stageIndex < 5; };
  const Grid grid = Grid::around(mesh, 16);
  Recutter recutter(grid, options);
  REQUIRE(recutter.cut(mesh));
  CHECK(recutter.cut(bad).error.status == Status::nonFiniteCoordinate);
  CHECK(recutter.cut(bad).error.element == 0);
  const CutResult again = recutter.cut(mesh);
  CHECK(recutter.counts().kept == 0);
  CHECK(differences(again.mesh, cut(mesh, grid).mesh) == std::vector<std::string>());
  isCancelled = true;
  CHECK(recutter.cut(mesh).error.status == Status::cancelled);
  isCancelled = false;
  REQUIRE(recutter.cut(mesh));
  CHECK(recutter.counts().kept == 0);
  REQUIRE(recutter.cut(mesh));
  CHECK(recutter.counts().kept == recutter.counts().bricks);
}

TEST_CASE("recut: a result that is kept is written over in place, through errors and cuts that it doesn't keep", "[recut]") {
  const Mesh mesh = ball();
  Mesh moved = mesh, bad = mesh;
  moved.positions[0] += 0.01;
  bad.positions[1] = NAN;
  const Grid grid = Grid::around(mesh, 64);
  Recutter recutter(grid);
  const auto check = [&](const Mesh& next, bool areKept) {
    const CutResult& result = recutter.recut(next);
    REQUIRE(result);
    CHECK((recutter.counts().kept > 0) == areKept);
    CHECK(differences(result.mesh, cut(next, grid).mesh) == std::vector<std::string>());
  };
  check(mesh, false);
  const CutResult& result = recutter.recut(mesh);
  const double* const positions = result.mesh.positions.data();
  const uint32_t* const loops = result.mesh.loopVertices.data();
  check(moved, true);
  CHECK(result.mesh.positions.data() == positions);
  CHECK(result.mesh.loopVertices.data() == loops);
  REQUIRE(recutter.cut(mesh));
  check(moved, true);
  CHECK(recutter.recut(bad).error.status == Status::nonFiniteCoordinate);
  CHECK(result.mesh.positions.empty());
  check(mesh, false);
  check(moved, true);
}

TEST_CASE("recut: a grid that can't be used is an error each time", "[recut]") {
  const Mesh mesh = ball();
  Recutter recutter(Grid{});
  CHECK(recutter.cut(mesh).error.status == Status::badGrid);
  CHECK(recutter.cut(mesh).error.status == Status::badGrid);
}
