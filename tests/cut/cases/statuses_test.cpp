// What can't be cut is named, and pointed at; progress is told and cancels.
#include <algorithm>
#include <limits>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

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
