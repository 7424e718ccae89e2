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

TEST_CASE("recut: a grid that can't be used is an error each time", "[recut]") {
  const Mesh mesh = ball();
  Recutter recutter(Grid{});
  CHECK(recutter.cut(mesh).error.status == Status::badGrid);
  CHECK(recutter.cut(mesh).error.status == Status::badGrid);
}
