// Cells of several sizes at the surface: that they fit together, fill what the cut of the grid fills, and are those of a cut with the
// smallest cells where all are divided.
#include "mandoline/refine.h"

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
#include "conforming_cells.h"
#include "mandoline/inside.h"
#include "mandoline/locate.h"
#include "mandoline/merge.h"
#include "mandoline/mesh_files.h"
#include "mesh_folder.h"
#include "refusal.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

/// One past a cell's block.
int32_t endOf(const RefinedCells& refined, size_t cell, size_t d) {
  const int64_t end = refined.cells.cellCorner[3 * cell + d] + (int64_t(1) << refined.cells.cellLevel[cell]);
  return int32_t(std::min(end, refined.cutMesh.grid.cells(int(d))));
}

/// Each face lies where the blocks of its cells meet, or in the block that both are in.
void requireNotEmptyBetweenBlocks(const RefinedCells& refined) {
  const CellComplex& cells = refined.cells;
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    const int8_t axis = f < cells.cutFaces ? refined.cutMesh.faceAxis[f]
                                           : int8_t(cells.faceNormal[3 * f] != 0       ? 0
                                                    : cells.faceNormal[3 * f + 1] != 0 ? 1
                                                                                       : 2);
    CAPTURE(f, int(axis));
    for (size_t side = 0; side < 2; ++side) {
      const int32_t cell = cells.faceCells[2 * f + side];
      if (cell < 0) continue;
      const size_t c = size_t(cell);
      for (size_t d = 0; d < 3; ++d) {
        const std::vector<double>& planes = refined.cutMesh.grid.planes[d];
        const double low = planes[size_t(cells.cellCorner[3 * c + d])], high = planes[size_t(endOf(refined, c, d))];
        for (const auto loop : cells.loops(f)) {
          for (const uint32_t v : loop) {
            const double x = cells.positions[3 * size_t(v) + d];
            REQUIRE((low <= x && x <= high));
            const bool isUpper = (cells.faceNormal[3 * f + d] > 0) == (side == 0);
            if (int(d) == axis) REQUIRE(x == (isUpper ? high : low));
          }
        }
      }
    }
    const int32_t a = cells.faceCells[2 * f], b = cells.faceCells[2 * f + 1];
    REQUIRE((a >= 0 || b >= 0));
    if (cells.faceTag[f] == FaceTag::inner) REQUIRE((a >= 0 && b >= 0 && cells.cellRegion[size_t(a)] == cells.cellRegion[size_t(b)]));
    if (a >= 0 && b >= 0) REQUIRE(std::abs(cells.cellLevel[size_t(a)] - cells.cellLevel[size_t(b)]) <= 1);
  }
}

/// The area of each triangle in the grid, on both sides.
void requireTriangleAreas(const CutMesh& cutMesh, const Measures& measures, const CutMesh& refined, const std::vector<double>& areas) {
  std::vector<double> before(cutMesh.triangleCount), after(cutMesh.triangleCount);
  for (size_t i = 0, f = 0; f < cutMesh.faceCount(); ++f) {
    for (; i < cutMesh.faceParentOffsets[f + 1]; ++i) before[cutMesh.faceParents[i]] += measures.faceArea[f];
  }
  for (size_t i = 0, f = 0; f < refined.faceCount(); ++f) {
    for (; i < refined.faceParentOffsets[f + 1]; ++i) after[refined.faceParents[i]] += areas[f];
  }
  for (size_t t = 0; t < before.size(); ++t) REQUIRE(after[t] == Approx(before[t]).epsilon(1e-12).margin(1e-300));
}

RefinedCells checkedRefinement(const Mesh& mesh, const Grid& grid, const RefineOptions& options) {
  const PrepareResult prepared = prepare(mesh);
  const CutResult whole = cut(mesh, grid);
  REQUIRE(prepared);
  REQUIRE(whole);
  RefinedCells refined = refineCells(prepared.mesh, whole.mesh, options);
  REQUIRE(checkArrays(refined.cells).message.empty());
  REQUIRE(refined.cells.cutCells == refined.cutMesh.cellCount());
  REQUIRE(refined.cutMesh.regionWinding == whole.mesh.regionWinding);
  requireClosedCells(refined.cells);
  requireAreasAndVolumes(refined.cells, mesh, whole.mesh);
  requireNotEmptyBetweenBlocks(refined);
  requireTriangleAreas(whole.mesh, measure(mesh, whole.mesh), refined.cutMesh, refined.cells.faceArea);
  return refined;
}

RefineOptions bending(int levels, double angle = 30, int maxLevel = 0) {
  RefineOptions options;
  options.levels = levels;
  options.angle = angle;
  options.coarsening.maxLevel = maxLevel;
  return options;
}

RefineOptions in(const RefinementBox& box) {
  RefineOptions options;
  options.boxes = {box};
  return options;
}

/// Of the grid's middle, off its planes.
RefinementBox middleOf(const Grid& grid, int levels) {
  RefinementBox box;
  for (size_t d = 0; d < 3; ++d) {
    const double low = grid.planes[d].front(), high = grid.planes[d].back();
    box.min[d] = low + 0.31 * (high - low);
    box.max[d] = low + 0.57 * (high - low);
  }
  box.levels = levels;
  return box;
}

std::vector<double> sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

/// The smallest cells everywhere are those of a cut with them.
void requireSameAsUniform(const Mesh& mesh, const Grid& grid, int levels) {
  RefinementBox all;
  for (size_t d = 0; d < 3; ++d) all.min[d] = grid.planes[d].front(), all.max[d] = grid.planes[d].back();
  all.levels = levels;
  const RefinedCells refined = checkedRefinement(mesh, grid, in(all));
  const CutResult fine = cut(mesh, dividedGrid(grid, levels));
  REQUIRE(fine);
  CoarsenOptions single;
  single.maxLevel = 0;
  const CellComplex uniform = cellComplex(mesh, fine.mesh, coarsen(fine.mesh, single));
  REQUIRE(refined.cells.cutCells == uniform.cutCells);
  REQUIRE(refined.cells.cellCount() == uniform.cellCount());
  REQUIRE(refined.cells.cutFaces == uniform.cutFaces);
  REQUIRE(refined.cells.faceCount() == uniform.faceCount());
  REQUIRE(refined.cells.vertexCount() == uniform.vertexCount());
  REQUIRE(refined.cells.loopVertices.size() == uniform.loopVertices.size());
  REQUIRE(sorted(refined.cells.cellVolume) == sorted(uniform.cellVolume));
  REQUIRE(sorted(refined.cells.faceArea) == sorted(uniform.faceArea));
  REQUIRE(sorted(refined.cells.positions) == sorted(uniform.positions));
}

}  // namespace

TEST_CASE("refine: all cases, where the surface bends, in a box, and beside octree cells", "[refine]") {
  for (const NamedCase& c : caseList()) {
    CAPTURE(c.name);
    checkedRefinement(c.mesh, c.grid, bending(1));
    checkedRefinement(c.mesh, c.grid, bending(2, 60, 2));
    checkedRefinement(c.mesh, c.grid, in(middleOf(c.grid, 2)));
  }
}

TEST_CASE("refine: cells that are divided everywhere are those of a cut with the smallest ones", "[refine]") {
  for (const NamedCase& c : caseList()) {
    if (c.grid.cells(0) * c.grid.cells(1) * c.grid.cells(2) > 1500) continue;
    CAPTURE(c.name);
    requireSameAsUniform(c.mesh, c.grid, 1);
  }
  requireSameAsUniform(shapes::icosphere({2, 2, 2}, 1.3, 2), unitGrid(4), 3);
}

TEST_CASE("refine: nothing is divided without levels", "[refine]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 2);
  const RefinedCells refined = checkedRefinement(ball, unitGrid(8), bending(0, 0, 2));
  const CutResult whole = cut(ball, unitGrid(8));
  CoarsenOptions options;
  options.maxLevel = 2;
  const CellComplex cells = cellComplex(ball, whole.mesh, coarsen(whole.mesh, options));
  CHECK(refined.levels == 0);
  CHECK(refined.cells.cellCount() == cells.cellCount());
  CHECK(refined.cells.faceCount() == cells.faceCount());
  CHECK(refined.cells.vertexCount() == cells.vertexCount());
}

TEST_CASE("refine: a cube is divided at its edges alone, a ball by its curvature", "[refine]") {
  const RefinedCells cube = checkedRefinement(shapes::cube(1.3, 6.7), unitGrid(8), bending(2));
  size_t flat = 0;
  for (size_t c = 0; c < cube.cells.cutCells; ++c) {
    const int32_t* at = &cube.cells.cellCorner[3 * c];
    const auto isMiddle = [&](size_t d) { return at[d] >= 12 && at[d] < 20; };
    if (int(isMiddle(0)) + int(isMiddle(1)) + int(isMiddle(2)) < 2) continue;
    ++flat;
    CHECK(cube.cells.cellLevel[c] == 2);
  }
  CHECK(flat > 0);
  CHECK(std::count(cube.cells.cellLevel.begin(), cube.cells.cellLevel.end(), 0) > 0);
  const Mesh ball = shapes::icosphere({4, 4, 4}, 3, 4);
  const RefinedCells coarse = checkedRefinement(ball, unitGrid(8), bending(3, 20));
  CHECK(*std::min_element(coarse.cells.cellLevel.begin(), coarse.cells.cellLevel.end()) == 2);  // a half turns by 17 degrees at most
}

TEST_CASE("refine: cells are divided where a function says so, which is asked of all of them", "[refine]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 2);
  const Grid grid = unitGrid(8);
  size_t asked = 0;
  RefineOptions options;
  options.rule.levels = 2;
  options.rule.divides = [&](const std::array<double, 3>& min, const std::array<double, 3>& max, int depth) {
    ++asked;
    for (size_t d = 0; d < 3; ++d) REQUIRE(max[d] - min[d] == std::ldexp(1, -depth));
    return max[0] <= (depth == 0 ? 4 : 2) && max[1] <= 4;  // in twos
  };
  const RefinedCells refined = checkedRefinement(ball, grid, options);
  CHECK(asked == 8 * 8 * 8 + 8 * 4 * 4 * 8);
  CHECK(refined.levels == 2);
  RefineOptions boxes;
  boxes.boxes = {{{0, 0, 0}, {4, 4, 8}, 1}, {{0, 0, 0}, {2, 4, 8}, 2}};
  const RefinedCells same = checkedRefinement(ball, grid, boxes);
  CHECK(refined.cells.cellCorner == same.cells.cellCorner);
  CHECK(refined.cells.cellVolume == same.cells.cellVolume);

  const PreparedMesh prepared = prepare(ball).mesh;
  const CutMesh whole = cut(ball, grid).mesh;
  options.rule.divides = [](const auto&, const auto&, int) { return true; };
  const RefinedCells all = refineCells(prepared, whole, options);
  CHECK(all.cells.cellCount() > 32 * 32 * 32);
  CHECK(all.cells.fingerprint != refined.cells.fingerprint);
  CHECK(all.cutMesh.fingerprint != refined.cutMesh.fingerprint);
  options.rule.divides = [](const auto&, const auto&, int) -> bool { throw std::string("mine"); };
  CHECK_THROWS_AS(refineCells(prepared, whole, options), std::string);
}

TEST_CASE("refine: layers of each size", "[refine]") {
  const Mesh ball = shapes::icosphere({8, 8, 8}, 0.7, 1);
  RefineOptions options = in({{7.1, 7.1, 7.1}, {8.9, 8.9, 8.9}, 2});
  const size_t one = checkedRefinement(ball, unitGrid(16), options).cells.cellCount();
  options.layers = 3;
  CHECK(checkedRefinement(ball, unitGrid(16), options).cells.cellCount() > one);
}

TEST_CASE("refine: sheets in planes that only some cells have, and triangles in planes between sizes", "[refine]") {
  const Mesh sheet = shapes::quad({0.7, 0.6, 2}, {3.4, 0.6, 2}, {3.4, 3.3, 2}, {0.7, 3.3, 2});
  const Mesh upright = shapes::quad({2, 0.6, 0.7}, {2, 3.4, 0.7}, {2, 3.4, 3.3}, {2, 0.6, 3.3});
  const Mesh between = shapes::quad({0.7, 2.25, 0.6}, {3.3, 2.25, 0.6}, {3.3, 2.25, 3.4}, {0.7, 2.25, 3.4});
  const Mesh along = shapes::quad({0.5, 0.5, 2}, {3.5, 3.5, 2}, {3.5, 3.5, 3.25}, {0.5, 0.5, 3.25});  // ends in a plane
  for (const RefinementBox& box :
       {RefinementBox{{0, 0, 0}, {2, 4, 4}, 2}, {{0, 0, 0}, {4, 4, 2}, 2}, {{2, 2, 2}, {4, 4, 4}, 1}, {{0, 2, 0}, {4, 4, 4}, 2}}) {
    for (const Mesh& mesh : {sheet, upright, between, along, shapes::merged({sheet, upright}), shapes::merged({sheet, between, along})})
      checkedRefinement(mesh, unitGrid(4), in(box));
  }
}

TEST_CASE("refine: a tip that touches a grid line between sizes", "[refine]") {
  for (const double x : {2.0, 2.25, 2.3}) {
    const Mesh tip = shapes::tetrahedron({x, 2, 2}, {x - 0.4, 3.2, 2.5}, {x + 0.4, 3.2, 2.5}, {x, 3.1, 3.4});
    for (const RefinementBox& box : {RefinementBox{{0, 0, 0}, {4, 2, 4}, 2}, {{0, 2, 0}, {4, 4, 4}, 2}, {{0, 0, 0}, {4, 2, 2}, 1}})
      checkedRefinement(tip, unitGrid(4), in(box));
  }
}

TEST_CASE("refine: a tip that touches the line between four parts, with small cells in one of them", "[refine]") {
  const Mesh tip = shapes::tetrahedron({2.3, 4, 4}, {1.9, 5.2, 5.3}, {2.7, 5.2, 5.3}, {2.3, 5, 5.5});
  checkedRefinement(tip, unitGrid(8), in({{0, 0, 0}, {8, 4, 4}, 2}));
}

TEST_CASE("refine: soups on a lattice, whose triangles meet everywhere", "[refine]") {
  size_t done = 0;
  for (const NamedCase& c : casesAndSoups()) {
    if (++done % 5 != 0) continue;
    CAPTURE(c.name);
    checkedRefinement(c.mesh, c.grid, in(middleOf(c.grid, 1)));
  }
}

TEST_CASE("refine: graded grids", "[refine]") {
  std::array<std::vector<double>, 3> planes;
  for (size_t d = 0; d < 3; ++d) {
    double x = 0;
    for (int i = 0; i <= 8; ++i, x += 0.5 + 0.125 * double(i % 5)) planes[d].push_back(x);
  }
  const Grid grid = Grid::rectilinear(planes);
  CHECK(dividedGrid(grid, 1).planes[0][3] == 0.625 / 2 + 1.375 / 2);
  checkedRefinement(shapes::icosphere({3.1, 3.2, 3.3}, 1.7, 3), grid, bending(2, 25, 1));
}

TEST_CASE("refine: the grid of a box keeps the planes of uniform cells", "[refine]") {
  const Grid grid = Grid::box({0, 0, 0}, {1, 1, 1}, {10, 10, 10}), divided = dividedGrid(grid, 2);
  CHECK(divided.uniform);
  CHECK(divided.planes == Grid::box({0, 0, 0}, {1, 1, 1}, {40, 40, 40}).planes);
}

TEST_CASE("refine: the result does not depend on the number of threads", "[refine]") {
  const Mesh ball = shapes::noisySphere({4, 4, 4}, 2.7, 0.2, 3);
  const PrepareResult prepared = prepare(ball);
  const CutResult whole = cut(ball, unitGrid(8));
  const auto bytesWith = [&](unsigned threads) {
    RefineOptions options = bending(2);
    options.threads = threads;
    const RefinedCells refined = refineCells(prepared.mesh, whole.mesh, options);
    std::string bytes = bytesOfFields(refined.cells);
    for (const auto& [name, part] : partsOf(refined.cutMesh)) bytes += part;
    return bytes;
  };
  CHECK(bytesWith(1) == bytesWith(4));
}

TEST_CASE("refine: small cells merge, also with others of other sizes, and walls unite", "[refine]") {
  for (const NamedCase& c : caseList()) {
    CAPTURE(c.name);
    const RefinedCells refined = checkedRefinement(c.mesh, c.grid, bending(1));
    const CutResult whole = cut(c.mesh, c.grid);
    const MergedCells merged = mergeSmallCells(refined.cutMesh, refined.cells);
    REQUIRE(checkArrays(merged.cells).message.empty());
    requireClosedCells(merged.cells);
    requireAreasAndVolumes(merged.cells, c.mesh, whole.mesh);
    size_t small = 0;
    for (size_t cell = 0; cell < merged.cells.cellCount(); ++cell) {
      double unit = 1;
      for (size_t d = 0; d < 3; ++d) {
        const std::vector<double>& planes = refined.cutMesh.grid.planes[d];
        const size_t first = size_t(merged.cells.cellCorner[3 * cell + d]);
        unit *= planes[std::min(first + (size_t(1) << merged.cells.cellLevel[cell]), planes.size() - 1)] - planes[first];
      }
      small += merged.cells.cellVolume[cell] < 0.2 * unit;
      REQUIRE(merged.cells.cellVolume[cell] <= 1.5 * unit * (1 + 1e-14));
    }
    REQUIRE(small == merged.pockets.size());
    const CellComplex united = uniteWalls(refined.cutMesh, merged.cells);
    REQUIRE(checkArrays(united).message.empty());
    requireClosedCells(united);
  }
}

TEST_CASE("refine: calls that can't be", "[refine]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 1), cube = shapes::cube(1, 2);
  const PreparedMesh prepared = prepare(ball).mesh;
  const CutMesh whole = cut(ball, unitGrid(8)).mesh;
  const auto status = [&](RefineOptions options) { return refusal([&] { refineCells(prepared, whole, options); }).first; };
  CHECK(status(bending(-1)) == Status::badOption);
  CHECK(status(bending(25)) == Status::badOption);
  CHECK(status(bending(1, -1)) == Status::badOption);
  CHECK(status(bending(1, std::nan(""))) == Status::badOption);
  CHECK(status(bending(22)) == Status::gridTooLarge);
  RefineOptions ruled;
  ruled.rule.levels = 1;
  CHECK(status(ruled) == Status::badOption);
  ruled.rule = {[](const auto&, const auto&, int) { return true; }, 0};
  CHECK(status(ruled) == Status::badOption);
  ruled.rule.levels = 25;
  CHECK(status(ruled) == Status::badOption);
  CHECK(status(in({{0, 0, 0}, {1, 0, 1}, 1})) == Status::badOption);
  CHECK(status(in({{0, 0, 0}, {1, INFINITY, 1}, 1})) == Status::badOption);
  CHECK(status(in({{0, 0, 0}, {1, 1, 1}, -1})) == Status::badOption);
  RefineOptions layers = bending(1);
  layers.layers = 0;
  CHECK(status(layers) == Status::badOption);
  RefineOptions cancelled = bending(1);
  cancelled.progress = [](const Progress&) { return false; };
  CHECK(status(cancelled) == Status::cancelled);
  const auto refuses = [&](const PreparedMesh& mesh, const CutMesh& cutMesh) {
    return refusal([&] { refineCells(mesh, cutMesh, bending(1)); }).first == Status::badArgument;
  };
  CHECK(refuses(prepare(cube).mesh, whole));
  CHECK(refuses({}, whole));
  CHECK(refuses(prepared, {}));
  CutOptions snapping;
  snapping.snapTolerance = 0.1;
  CHECK(refuses(prepared, cut(ball, unitGrid(8), snapping).mesh));
}

TEST_CASE("refine: functions that need the cut of a grid refuse that of refined cells", "[refine]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 1);
  const RefinedCells refined = refineCells(prepare(ball).mesh, cut(ball, unitGrid(8)).mesh, bending(1));
  const auto refuses = [](const auto& call) { return refusal(call).first == Status::badArgument; };
  CHECK(refuses([&] { coarsen(refined.cutMesh); }));
  CHECK(refuses([&] { measure(ball, refined.cutMesh); }));
  CHECK(refuses([&] { adjacency(refined.cutMesh); }));
  CHECK(refuses([&] { cellsAt(refined.cutMesh, std::vector<double>{4, 4, 4}); }));
  CHECK(refuses([&] { estimateInside(ball, refined.cutMesh); }));
  CHECK(refuses([&] { refineCells(prepare(ball).mesh, refined.cutMesh); }));
  CHECK(UntouchedCells(refined.cutMesh).regionAt(0, 0, 0) == -1);
}

TEST_CASE("refine: meshes of the collection", "[refine][meshes]") {
  const auto folder = meshFolder();
  if (!folder) return;
  for (const char* name :
       {"igltut_sphere", "trimesh_box", "codim_mat60x60", "igltest_cube_with_fold", "lagrange_nonmanifold_vertex",
        "wmdata_edge_with_four_triangles", "igltest_two-boxes-bad-self-union", "manifold_self_intersectA", "farma_three_cubes",
        "cgal_hedra_open", "geocentral_triple_vierbein", "openscad_issue1580-back-to-back", "geocentral_moebius", "pmp_hole_capsule"}) {
    CAPTURE(name);
    const Mesh mesh = readMesh((*folder / (std::string(name) + ".obj.gz")).string());
    const Grid grid = Grid::around(mesh, 7);
    checkedRefinement(mesh, grid, bending(2, 30, 1));
    checkedRefinement(mesh, grid, in(middleOf(grid, 2)));
  }
}

TEST_CASE("refine: cells that doubles can't compute on are refused", "[refine]") {
  for (const double scale : {1e-300, 1e200}) {
    CAPTURE(scale);
    Mesh mesh = shapes::cube(0.5, 1.5);
    for (double& x : mesh.positions) x *= scale;
    const CutMesh cutMesh = cut(mesh, Grid::box({0, 0, 0}, {2 * scale, 2 * scale, 2 * scale}, {2, 2, 2})).mesh;
    RefineOptions options;
    options.levels = 1;
    CHECK(refusal([&] { refineCells(prepare(mesh).mesh, cutMesh, options); }).first == Status::badArgument);
  }
}
