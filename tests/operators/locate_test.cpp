// Which cell holds a point: against winding numbers, at places where points lie on things, and where rounding has bent the cells.
#include "mandoline/locate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>

#include "catch.h"
#include "checked_cut.h"
#include "mandoline/triangulate.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

using Point = shapes::Point;

std::vector<double> randomPoints(const Grid& grid, size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> points;
  for (size_t i = 0; i < 3 * count; ++i) {
    const auto& planes = grid.planes[i % 3];
    points.push_back(planes.front() + (planes.back() - planes.front()) * (double(random()) * 0x1p-32));
  }
  return points;
}

/// Winding number of a triangle surface by solid angles.
double windingNumber(const CutMesh& mesh, const std::vector<uint32_t>& triangles, const double* p) {
  double sum = 0;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    double r[3][3], length[3];
    for (int i = 0; i < 3; ++i) {
      for (int d = 0; d < 3; ++d) r[i][d] = mesh.positions[3 * triangles[t + i] + d] - p[d];
      length[i] = std::hypot(r[i][0], r[i][1], r[i][2]);
    }
    const auto dot = [&](int i, int j) { return r[i][0] * r[j][0] + r[i][1] * r[j][1] + r[i][2] * r[j][2]; };
    const double volume = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                          r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    sum +=
        2 * std::atan2(volume, length[0] * length[1] * length[2] + dot(0, 1) * length[2] + dot(1, 2) * length[0] + dot(2, 0) * length[1]);
  }
  return sum / (4 * std::numbers::pi);
}

/// What holds for any points in the grid: they lie in their grid cell, and in one cell of it.
void requireComplete(const CutMesh& mesh, const std::vector<double>& points, const Locations& locations) {
  const std::vector<int32_t> untouched = mesh.gridCellRegion();
  bool inBox = true, found = true, consistent = true;
  for (size_t i = 0; i < points.size() / 3; ++i) {
    const int32_t* g = &locations.gridCell[3 * i];
    for (int d = 0; d < 3; ++d) {
      const auto& planes = mesh.grid.planes[d];
      inBox = inBox && g[d] >= 0 && g[d] < mesh.grid.cells(d) && planes[size_t(g[d])] <= points[3 * i + d] &&
              points[3 * i + d] <= planes[size_t(g[d]) + 1];
    }
    REQUIRE(inBox);
    const int32_t region = untouched[size_t(g[0] + mesh.grid.cells(0) * (g[1] + mesh.grid.cells(1) * g[2]))];
    const int32_t cell = locations.cell[i];
    found &= (cell >= 0) == (region < 0);
    consistent &= cell < 0 ? locations.region[i] == region
                           : locations.region[i] == int32_t(mesh.cellRegion[size_t(cell)]) &&
                                 std::equal(g, g + 3, &mesh.cellGridCell[3 * size_t(cell)]);
  }
  REQUIRE(found);
  REQUIRE(consistent);
}

void requireRight(const CutMesh& mesh, const std::vector<double>& points) {
  const Locations locations = cellsAt(mesh, points);
  requireComplete(mesh, points, locations);
  for (size_t i = 0; i < points.size() / 3; ++i) {
    if (locations.cell[i] < 0) continue;
    INFO("point " << points[3 * i] << " " << points[3 * i + 1] << " " << points[3 * i + 2] << " cell " << locations.cell[i]);
    REQUIRE(windingNumber(mesh, triangulateCell(mesh, size_t(locations.cell[i])), &points[3 * i]) == Approx(1).margin(1e-6));
  }
}

/// Tri-vertices, made vertices, and middles of edges and faces: all on faces, as far as doubles can be.
std::vector<double> pointsOnFaces(const CutMesh& mesh) {
  std::vector<double> points = mesh.positions;
  for (size_t l = 0; l < mesh.loopCount(); ++l) {
    const auto loop = mesh.loop(l);
    for (size_t i = 0; i < loop.size(); ++i) {
      for (int d = 0; d < 3; ++d)
        points.push_back(0.5 * mesh.positions[3 * loop[i] + d] + 0.5 * mesh.positions[3 * loop[(i + 1) % loop.size()] + d]);
    }
  }
  return points;
}

const Mesh& knottedShapes() {
  using namespace shapes;
  static const Mesh mesh =
      merged({icosphere({1.3, 1.2, 1.4}, 0.9, 2), flipped(icosphere({1.3, 1.2, 1.4}, 0.5, 1)), torus({3.1, 3.2, 2.7}, 0.7, 0.2, 12, 6),
              fan({0.7, 3.3, 0.4}, 2.5, {{0.3, 0.2}, {-0.3, 0.2}, {0, -0.4}}), moebius({3.2, 1, 3.3}, 0.4, 0.3, 12),
              octahedron({2.5, 2.5, 0.5}, 0.25), quad({2.2, 3.2, 0.3}, {2.8, 3.2, 0.3}, {2.8, 3.8, 0.4}, {2.2, 3.8, 0.4})});
  return mesh;
}

}  // namespace

TEST_CASE("cut() makes the cut-cells of a grid cell one after the other, x fastest", "[locate]") {
  const CheckedCut cut = checkedCut(knottedShapes(), unitGrid(4));
  const auto& g = cut.mesh.cellGridCell;
  for (size_t c = 1; c < cut.mesh.cellCount(); ++c) {
    REQUIRE(std::tie(g[3 * c - 1], g[3 * c - 2], g[3 * c - 3]) <= std::tie(g[3 * c + 2], g[3 * c + 1], g[3 * c]));
  }
}

TEST_CASE("a point lies in the cell that winds around it", "[locate]") {
  SECTION("many cells") {
    const CheckedCut cut = checkedCut(knottedShapes(), Grid::box({0, 0, 0}, {4, 4, 4}, {6, 5, 7}));
    requireRight(cut.mesh, randomPoints(cut.mesh.grid, 4000, 1));
  }
  SECTION("several cells in one grid cell, cavities, floating sheets") {
    const CheckedCut cut = checkedCut(knottedShapes(), Grid::box({0, 0, 0}, {4, 4, 4}, {1, 1, 1}));
    REQUIRE(cut.mesh.cellCount() > 4);
    requireRight(cut.mesh, randomPoints(cut.mesh.grid, 2000, 2));
  }
  SECTION("a grid that is not uniform") {
    const CheckedCut cut = checkedCut(knottedShapes(), Grid::rectilinear({{{-1, 0, 0.5, 3.9, 5}, {0, 1, 4}, {0, 0.125, 0.5, 2, 4}}}));
    requireRight(cut.mesh, randomPoints(cut.mesh.grid, 2000, 3));
  }
}

TEST_CASE("points on a lattice lie inside or outside of a cube on it, even where they touch it", "[locate]") {
  const CheckedCut cut = checkedCut(shapes::cube(0.75, 2.25), unitGrid(3));
  const auto outside = cellsAt(cut.mesh, std::vector<double>{0.1, 0.1, 0.1}).region[0];
  std::vector<double> points;
  for (int i = 0; i < 13 * 13 * 13; ++i) points.insert(points.end(), {0.25 * (i % 13), 0.25 * (i / 13 % 13), 0.25 * (i / 169)});
  const Locations locations = cellsAt(cut.mesh, points);
  requireComplete(cut.mesh, points, locations);
  for (size_t i = 0; i < points.size() / 3; ++i) {
    double distance = 0;  // from the centre
    for (int d = 0; d < 3; ++d) distance = std::max(distance, std::fabs(points[3 * i + d] - 1.5));
    if (distance != 0.75) CHECK((locations.region[i] == outside) == (distance > 0.75));
  }
}

TEST_CASE("a point on a face counts to a cell beside it", "[locate]") {
  const CheckedCut cut = checkedCut(knottedShapes(), unitGrid(4));
  const std::vector<double> points = pointsOnFaces(cut.mesh);
  const Locations locations = cellsAt(cut.mesh, points);
  requireComplete(cut.mesh, points, locations);
  constexpr size_t kNearby = 100;
  std::mt19937 random(8);
  std::vector<double> nearby;
  for (size_t i = 0; i < points.size() / 3; ++i) {
    for (size_t n = 0; n < kNearby; ++n) {
      for (int d = 0; d < 3; ++d) nearby.push_back(std::clamp(points[3 * i + d] + 1e-7 * (double(random()) * 0x1p-31 - 1), 0., 4.));
    }
  }
  const Locations around = cellsAt(cut.mesh, nearby);
  size_t beside = 0;
  for (size_t i = 0; i < points.size() / 3; ++i) {
    bool found = false;
    for (size_t n = i * kNearby; n < (i + 1) * kNearby; ++n) {
      found |= around.cell[n] == locations.cell[i] &&
               std::equal(&around.gridCell[3 * n], &around.gridCell[3 * n] + 3, &locations.gridCell[3 * i]);
    }
    beside += found;
  }
  CHECK(beside == points.size() / 3);
}

TEST_CASE("the grid's border belongs to it, and nothing beyond", "[locate]") {
  const CheckedCut cut = checkedCut(shapes::cube(-1, 1.5), unitGrid(2));
  const double inf = INFINITY, nan = std::numeric_limits<double>::quiet_NaN(), beyond = std::nextafter(2, 3);
  const std::vector<double> outside = {beyond, 1, 1, 1, -1e-300, 1, inf, 1, 1, 1, -inf, 1, 1, 1, nan, nan, nan, nan, 1e300, 0, 0};
  const Locations none = cellsAt(cut.mesh, outside);
  CHECK(std::all_of(none.cell.begin(), none.cell.end(), [](int32_t x) { return x == -1; }));
  CHECK(std::all_of(none.region.begin(), none.region.end(), [](int32_t x) { return x == -1; }));
  CHECK(std::all_of(none.gridCell.begin(), none.gridCell.end(), [](int32_t x) { return x == -1; }));
  std::vector<double> border;
  for (int i = 0; i < 125; ++i) border.insert(border.end(), {0.5 * (i % 5), 0.5 * (i / 5 % 5), 0.5 * (i / 25)});
  requireComplete(cut.mesh, border, cellsAt(cut.mesh, border));
  CHECK(cellsAt(cut.mesh, std::vector<double>{2, 2, 2}).gridCell == std::vector<int32_t>{1, 1, 1});
  CHECK(cellsAt(cut.mesh, std::vector<double>{1, 1, 1}).gridCell == std::vector<int32_t>{1, 1, 1});
  CHECK(cellsAt(cut.mesh, {}).cell.empty());
}

TEST_CASE("points of two coordinates, and an empty cut-mesh, are refused", "[locate]") {
  const CheckedCut cut = checkedCut(shapes::cube(0.5, 1.5), unitGrid(2));
  for (const size_t count : {1, 2, 4, 3001}) {
    CHECK(refusal([&] { cellsAt(cut.mesh, std::vector<double>(count, 1)); }) == std::pair(Status::badArgument, int64_t(-1)));
  }
  CHECK(refusal([] { cellsAt(CutMesh(), std::vector<double>{0, 0, 0}); }).first == Status::badArgument);
  CHECK(refusal([] { cellsAt(CutMesh(), {}); }).first == Status::badArgument);
}

TEST_CASE("one cell holds a point also where rounding has bent the cells", "[locate]") {
  // Around 2^49 doubles are 1/8 apart: vertices of cells of size 2 are rounded by up to a sixteenth.
  const double far = 0x1p49;
  Mesh mesh = shapes::merged({shapes::translated(shapes::scaled(shapes::noisySphere({0, 0, 0}, 1, 0.3, 2), {4, 4, 4}), {far, far, far}),
                              shapes::translated(shapes::quad({5, -6, -6}, {6, 6, -6}, {5.5, 6, 6}, {5, -6, 6}), {far, far, far})});
  const Grid grid = Grid::box({far - 8, far - 8, far - 8}, {far + 8, far + 8, far + 8}, {8, 8, 8});
  const CutResult cut = mandoline::cut(mesh, grid);
  REQUIRE(cut);
  const std::vector<double> points = randomPoints(grid, 20000, 4);
  requireComplete(cut.mesh, points, cellsAt(cut.mesh, points));
  const std::vector<double> onFaces = pointsOnFaces(cut.mesh);
  requireComplete(cut.mesh, onFaces, cellsAt(cut.mesh, onFaces));
}

TEST_CASE("a point's cell depends on neither the other points nor the scale", "[locate]") {
  const CheckedCut cut = checkedCut(knottedShapes(), unitGrid(4));
  const std::vector<double> points = randomPoints(cut.mesh.grid, 300, 5);
  const Locations together = cellsAt(cut.mesh, points);
  for (size_t i = 0; i < 300; ++i) REQUIRE(cellsAt(cut.mesh, std::span(points).subspan(3 * i, 3)).cell[0] == together.cell[i]);
  for (const double scale : {0x1p-900, 0x1p900}) {
    const Grid grid = Grid::box({0, 0, 0}, {4 * scale, 4 * scale, 4 * scale}, {4, 4, 4});
    const Mesh mesh = shapes::scaled(knottedShapes(), {scale, scale, scale});
    const CutResult scaled = mandoline::cut(mesh, grid);
    REQUIRE(scaled);
    std::vector<double> scaledPoints = points;
    for (double& x : scaledPoints) x *= scale;
    CHECK(cellsAt(scaled.mesh, scaledPoints).cell == together.cell);
  }
}

TEST_CASE("many points among many triangles of one grid cell", "[locate]") {
  const Mesh mesh = shapes::icosphere({0, 0, 0}, 1, 5);  // 20480 triangles
  const CutResult cut = mandoline::cut(mesh, Grid::box({-2, -2, -2}, {2, 2, 2}, {1, 1, 1}));
  REQUIRE(cut);
  const std::vector<double> points = randomPoints(cut.mesh.grid, 50000, 6);
  const Locations locations = cellsAt(cut.mesh, points);
  const auto inside = cellsAt(cut.mesh, std::vector<double>{0, 0, 0}).cell[0];
  size_t wrong = 0;
  for (size_t i = 0; i < points.size() / 3; ++i) {
    const double radius = std::hypot(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    wrong += (radius < 0.998 && locations.cell[i] != inside) || (radius > 1 && locations.cell[i] == inside);
  }
  CHECK(wrong == 0);
}
