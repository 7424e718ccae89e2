// Faces that meet where they should not are found, and those that only seem to meet pass.
#include <algorithm>
#include <cmath>
#include <random>

#include "catch.h"
#include "mandoline/mandoline.h"
#include "mandoline/measure.h"
#include "sketches.h"

using namespace mandoline;
using namespace sketches;

namespace {

/// Sheets, each a square of two triangles.
Mesh squares(const std::vector<std::array<Point, 4>>& corners) {
  Mesh mesh;
  for (const std::array<Point, 4>& c : corners) {
    const uint32_t v = uint32_t(mesh.vertexCount());
    for (const Point& p : c) mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + 2, v, v + 2, v + 3});
  }
  return mesh;
}

Validation validatedCut(const Mesh& mesh, const Grid& grid, Intersections intersections, size_t cells) {
  CutOptions options;
  options.intersections = intersections;
  const CutResult result = cut(mesh, grid, options);
  INFO(result.error.message);
  REQUIRE(result);
  CHECK(result.mesh.cellCount() == cells);
  return validate(mesh, result.mesh);
}

/// Cut-cells by grid cell and volume.
std::vector<std::array<double, 4>> cellsOf(const Mesh& mesh, const CutMesh& cutMesh) {
  const Measures measures = measure(mesh, cutMesh);
  std::vector<std::array<double, 4>> cells;
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    const int32_t* g = &cutMesh.cellGridCell[3 * c];
    cells.push_back({double(g[0]), double(g[1]), double(g[2]), std::round(measures.cellVolume[c] * 1e9)});
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace

TEST_CASE("validate: bubbles that intersect inside of a grid cell", "[validate]") {
  Bubbles b;
  b.tetrahedron(0.125, 0.125, 0.125, 0.5);
  const std::vector<uint32_t> first = b.outward;
  b.tetrahedron(0.15625, 0.15625, 0.15625, 0.5);
  b.cell({0, 0, 0}, 0, joined(b.boxSides, b.inward));
  b.cell({0, 0, 0}, 1, first);
  b.cell({0, 0, 0}, 2, std::vector<uint32_t>(b.outward.begin() + 4, b.outward.end()));
  b.setWinding({0, 1, 1});
  const Validation validation = b.validated();
  CHECK_FALSE(checkNamed(validation, "crossings").pass);
  CHECK_FALSE(checkNamed(validation, "partition").pass);
  CHECK(checkNamed(validation, "closedCells").pass);
  CHECK(checkNamed(validation, "gridCellVolume").pass);
  CHECK(checkNamed(validation, "inputVolume").pass);
}

TEST_CASE("validate: sheets that meet inside a grid cell, unresolved and resolved", "[validate]") {
  const Grid grid = Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const auto requireFound = [&](const Mesh& mesh, size_t cells, size_t resolvedCells) {
    for (int axis = 0; axis < 3; ++axis) {
      Mesh turned = mesh;
      for (size_t i = 0; i < mesh.positions.size(); ++i) turned.positions[i] = mesh.positions[i / 3 * 3 + (i + size_t(axis)) % 3];
      INFO("axis " << axis);
      CHECK_FALSE(checkNamed(validatedCut(turned, grid, Intersections::assumeNone, cells), "crossings").pass);
      requirePass(validatedCut(turned, grid, Intersections::resolve, resolvedCells));
    }
  };
  const double l = -0.5, m = 0.5, h = 1.5;
  SECTION("three squares through its middle, reaching beyond it") {
    requireFound(squares({{{{m, l, l}, {m, h, l}, {m, h, h}, {m, l, h}}},
                          {{{l, m, l}, {l, m, h}, {h, m, h}, {h, m, l}}},
                          {{{l, l, m}, {h, l, m}, {h, h, m}, {l, h, m}}}}),
                 1, 8);
  }
  SECTION("two squares in one plane that overlap by a quarter") {
    requireFound(squares({{{{0.25, 0.25, m}, {0.5, 0.25, m}, {0.5, 0.5, m}, {0.25, 0.5, m}}},
                          {{{0.375, 0.375, m}, {0.625, 0.375, m}, {0.625, 0.625, m}, {0.375, 0.625, m}}}}),
                 1, 1);
  }
  SECTION("the edge of a sheet on another one") {
    requireFound(squares({{{{0.25, 0.25, m}, {0.75, 0.25, m}, {0.75, 0.75, m}, {0.25, 0.75, m}}},
                          {{{0.4375, 0.375, m}, {0.4375, 0.625, m}, {0.4375, 0.625, 0.75}, {0.4375, 0.375, 0.75}}}}),
                 1, 1);
  }
}

TEST_CASE("validate: sheets that meet in a grid plane, each from its own side", "[validate]") {
  const Grid grid = Grid::regular({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  const Mesh mesh{{0, 0, 2, 0, 1, 1, 1, 1, 2, 2, 1, 1, 1, 2, 1, 0, 1, 2}, {0, 1, 2, 3, 4, 5}};  // whose edges cross at y = 1
  const Validation unresolved = validatedCut(mesh, grid, Intersections::assumeNone, 6);
  CHECK_FALSE(checkNamed(unresolved, "crossings").pass);
  CHECK_FALSE(checkNamed(unresolved, "gridFaces").pass);
  requirePass(validatedCut(mesh, grid, Intersections::resolve, 7));
}

TEST_CASE("validate: sheets a rounding apart, or crossing by as little", "[validate]") {
  std::mt19937 random(11);
  const Grid grid = Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  size_t apart = 0, crossing = 0;
  for (int pair = 0; pair < 300; ++pair) {
    Mesh mesh;
    for (uint32_t i = 0; i < 6; ++i) {
      const double x = double(random() % 5 + 1) / 8, y = 0.5 + double(random() % 4) * 0x1p-53, z = double(random() % 5 + 1) / 8;
      mesh.positions.insert(mesh.positions.end(), {x, y, z});
      mesh.triangles.push_back(i);
    }
    const PairCounts pairs = findIntersections(mesh).counts;
    CutOptions options;
    options.intersections = Intersections::assumeNone;
    const CutResult result = cut(mesh, grid, options);
    if (!result || pairs.touching > 0) continue;
    INFO("pair " << pair);
    const Validation validation = validate(mesh, result.mesh);
    if (pairs.total() == 0) {
      ++apart;
      requirePass(validation);
    } else {
      ++crossing;
      CHECK_FALSE(checkNamed(validation, "crossings").pass);
    }
  }
  CHECK(apart > 30);
  CHECK(crossing > 30);
}

TEST_CASE("validate: grid-faces that a sheet divides, but that are left whole", "[validate]") {
  Sketch s(1, 1, 1);
  const std::vector<uint32_t> sides = s.box(0);
  const double m = 0.5;
  const uint32_t f = s.wholeTriangle(s.triangle({0, 0, m}, {1, 0, m}, {1, 1, m}));
  const uint32_t g = s.wholeTriangle(s.triangle({0, 0, m}, {1, 1, m}, {0, 1, m}));
  for (size_t i = 0; i < 6; ++i) {  // the corners of the sheet lie on upright edges of the cell
    if (i / 2 == 2) continue;
    const uint32_t side = sides[i] / 2, loop = s.cut.faceLoopOffsets[side];
    std::vector<uint32_t> corners(s.cut.loop(loop).begin(), s.cut.loop(loop).end());
    for (size_t k = 0; k < corners.size(); ++k) {
      const double* p = &s.cut.positions[3 * corners[k]];
      const double* q = &s.cut.positions[3 * corners[(k + 1) % corners.size()]];
      if (p[2] != q[2]) corners.insert(corners.begin() + std::ptrdiff_t(k++) + 1, s.vertex({p[0], p[1], m}));
    }
    const auto first = s.cut.loopVertices.begin() + s.cut.loopOffsets[loop];
    s.cut.loopVertices.erase(first, first + 4);
    s.cut.loopVertices.insert(s.cut.loopVertices.begin() + s.cut.loopOffsets[loop], corners.begin(), corners.end());
    for (size_t l = loop + 1; l < s.cut.loopOffsets.size(); ++l) s.cut.loopOffsets[l] += 2;
  }
  s.cell({0, 0, 0}, 0, joined(sides, {2 * f, 2 * f + 1, 2 * g, 2 * g + 1}));
  s.finishRow();
  requireOnly(s.validated(), {"gridFaces"});
}

TEST_CASE("validate: cuts that assume no intersections pass only if they have the cells of the resolved ones", "[validate]") {
  std::mt19937 random(3);
  size_t passed = 0, failed = 0;
  for (int soup = 0; soup < 600; ++soup) {
    Mesh mesh;
    for (uint32_t i = 0; i < 6; ++i) {
      for (int d = 0; d < 3; ++d) mesh.positions.push_back(double(random() % 3));
      mesh.triangles.push_back(i);
    }
    const int64_t n = soup % 2 + 2;
    const Grid grid = Grid::box({0, 0, 0}, {2, 2, 2}, {n, n, n});
    CutOptions options;
    options.intersections = Intersections::assumeNone;
    const CutResult unresolved = cut(mesh, grid, options), resolved = cut(mesh, grid);
    if (!unresolved) continue;
    REQUIRE(resolved);
    INFO("soup " << soup);
    const bool pass = validate(mesh, unresolved.mesh).pass;
    if (pass) CHECK(cellsOf(mesh, unresolved.mesh) == cellsOf(mesh, resolved.mesh));
    ++(pass ? passed : failed);
  }
  CHECK(passed > 200);
  CHECK(failed > 50);
}

TEST_CASE("validate: faces of floating triangles that cross or lie on each other where no edge shows it", "[validate]") {
  Sketch s(1, 1, 1);
  const std::vector<uint32_t> sides = s.box(0);
  uint32_t f = 0, g = 0;
  SECTION("each has a corner inside the other") {
    f = s.wholeTriangle(s.triangle({0.625, 0.5, 0.5}, {0.125, 0.5, 0.25}, {0.125, 0.5, 0.75}));
    g = s.wholeTriangle(s.triangle({0.25, 0.5, 0.5}, {0.875, 0.25, 0.5}, {0.875, 0.75, 0.5}));
  }
  SECTION("one triangle twice") {
    f = s.wholeTriangle(s.triangle({0.625, 0.5, 0.5}, {0.125, 0.5, 0.25}, {0.125, 0.5, 0.75}));
    g = s.wholeTriangle(s.triangle({0.625, 0.5, 0.5}, {0.125, 0.5, 0.25}, {0.125, 0.5, 0.75}));
  }
  s.cell({0, 0, 0}, 0, joined(sides, {2 * f, 2 * f + 1, 2 * g, 2 * g + 1}));
  s.finishRow();
  requireFailure(s.validated(), "crossings", "face", g);
}

TEST_CASE("validate: soups of triangles with corners on a coarse lattice pass once resolved", "[validate]") {
  std::mt19937 random(7);
  for (int soup = 0; soup < 10; ++soup) {
    Mesh mesh;
    for (uint32_t i = 0; i < 30; ++i) {
      for (int d = 0; d < 3; ++d) mesh.positions.push_back(double(random() % 3) / 2);
      mesh.triangles.push_back(i);
    }
    for (const int64_t n : {1, 2, 3}) {
      const CutResult result = cut(mesh, Grid::regular({0, 0, 0}, {1.0 / double(n), 1.0 / double(n), 1.0 / double(n)}, {n, n, n}));
      INFO("soup " << soup << ", n = " << n << " " << result.error.message);
      REQUIRE(result);
      requirePass(validate(mesh, result.mesh));
    }
  }
}

TEST_CASE("validate: made vertices", "[validate]") {
  const Mesh mesh = squares({{{{0.25, 0.25, 0.25}, {0.875, 0.25, 0.75}, {0.875, 0.875, 0.75}, {0.25, 0.875, 0.375}}},
                             {{{0.125, 0.5, 0.125}, {0.75, 0.5, 0.125}, {0.75, 0.625, 0.875}, {0.125, 0.625, 0.875}}}});
  const CutResult result = cut(mesh, Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
  REQUIRE(result);
  REQUIRE(result.mesh.madeVertices.size() >= 2);
  requirePass(validate(mesh, result.mesh));
  CutMesh damaged = result.mesh;
  const uint32_t first = damaged.madeVertices[0];
  SECTION("of other parents") {
    REQUIRE(damaged.madeVertexKinds[0] == damaged.madeVertexKinds[1]);
    std::copy_n(damaged.madeVertexParents.begin() + 4, 4, damaged.madeVertexParents.begin());
    requireFailure(validate(mesh, damaged), "vertices", "vertex", damaged.madeVertices[1]);
    requireFailure(validate(mesh, damaged), "positions", "vertex", first);
  }
  SECTION("somewhere else on its triangle") {
    damaged.positions[3 * first] += 1e-9;
    CHECK_FALSE(checkNamed(validate(mesh, damaged), "positions").pass);
  }
  SECTION("not listed as made") {
    damaged.madeVertices.erase(damaged.madeVertices.begin());
    damaged.madeVertexKinds.erase(damaged.madeVertexKinds.begin());
    damaged.madeVertexParents.erase(damaged.madeVertexParents.begin(), damaged.madeVertexParents.begin() + 4);
    requireFailure(validate(mesh, damaged), "vertices", "vertex", first);
  }
}
