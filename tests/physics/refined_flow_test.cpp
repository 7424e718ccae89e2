// Flow on cells of several sizes at the surface.
#include "catch.h"
#include "mandoline/flow.h"
#include "mandoline/merge.h"
#include "mandoline/refine.h"
#include "shapes.h"

using namespace mandoline;

namespace {

CellComplex refinedCells(const Mesh& mesh, const Grid& grid, const RefineOptions& options) {
  const CutResult whole = cut(mesh, grid);
  REQUIRE(whole);
  const RefinedCells refined = refineCells(prepare(mesh).mesh, whole.mesh, options);
  return mergeSmallCells(refined.cutMesh, refined.cells).cells;
}

/// The largest difference from the flow about a ball of radius 1 in unbounded space, of velocities in cells within two radii.
double errorAboutBall(const CellComplex& cells) {
  FlowOptions options;
  options.farField = true;
  const Flow flow = solveFlow(cells, {1, 0, 0}, options);
  REQUIRE(flow.status == SolveStatus::converged);
  double largest = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double *p = &cells.cellCentroid[3 * c], *v = &flow.cellVelocity[3 * c];
    const double r2 = p[0] * p[0] + p[1] * p[1] + p[2] * p[2], r3 = r2 * std::sqrt(r2);
    if (r2 < 1 || r2 > 4) continue;
    for (size_t d = 0; d < 3; ++d) {
      const double exact = d == 0 ? 1 + 0.5 / r3 - 1.5 * p[0] * p[0] / (r3 * r2) : -1.5 * p[0] * p[d] / (r3 * r2);
      largest = std::max(largest, std::fabs(v[d] - exact));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("refined flow: about a ball, small cells at the surface do as well as small cells everywhere", "[refined flow]") {
  const Mesh ball = shapes::icosphere({0, 0, 0}, 1, 5);
  const Grid grid = Grid::box({-3, -3, -3}, {3, 3, 3}, {12, 12, 12});
  RefineOptions options;
  options.levels = 1;
  options.angle = 0;
  const CellComplex refined = refinedCells(ball, grid, options), coarse = refinedCells(ball, grid, {}),
                    uniform = refinedCells(ball, dividedGrid(grid, 1), {});
  const double error = errorAboutBall(refined);
  CAPTURE(error, errorAboutBall(uniform), errorAboutBall(coarse), refined.cellCount(), uniform.cellCount());
  CHECK(error < 1.2 * errorAboutBall(uniform));
  CHECK(error < 0.6 * errorAboutBall(coarse));
  CHECK(refined.cellCount() < uniform.cellCount() / 2);
}

TEST_CASE("refined flow: along a sheet through cells of all sizes it is the wind", "[refined flow]") {
  const Mesh sheet = shapes::quad({1.3, 2.1, 1.2}, {4.7, 2.1, 1.2}, {4.7, 2.1, 4.6}, {1.3, 2.1, 4.6});
  RefineOptions options;
  options.boxes = {{{1.6, 0, 0}, {3, 3, 3}, 2}};
  const CellComplex cells = refinedCells(sheet, Grid::box({0, 0, 0}, {6, 6, 6}, {6, 6, 6}), options);
  const Flow flow = solveFlow(cells, {1, 0, 0.5});
  REQUIRE(flow.status == SolveStatus::converged);
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const std::array<double, 3> wind = {1, 0, 0.5};
    for (size_t d = 0; d < 3; ++d) REQUIRE(flow.cellVelocity[3 * c + d] == Approx(wind[d]).margin(1e-6));
  }
}

namespace {

/// A flow whose velocity in a cell is the cell's number.
Flow numbered(const CellComplex& cells) {
  Flow flow;
  flow.wind = {1, 0, 0};
  flow.madeFrom = cells.fingerprint;
  flow.cellVelocity.assign(3 * cells.cellCount(), 0);
  flow.cellGradient.assign(6 * cells.cellCount(), 0);
  for (size_t c = 0; c < cells.cellCount(); ++c) flow.cellVelocity[3 * c] = double(c);
  return flow;
}

RefinedCells refinedSheet(const Mesh& sheet) {
  RefineOptions options;
  options.boxes = {{{1.6, 0, 0}, {3, 3, 3}, 2}};
  options.coarsening.maxLevel = 2;
  return refineCells(prepare(sheet).mesh, cut(sheet, Grid::box({0, 0, 0}, {7, 6, 6}, {7, 6, 6})).mesh, options);
}

}  // namespace

TEST_CASE("refined flow: points are found in cells of all sizes, before and after small ones merge", "[refined flow]") {
  const Mesh sheet = shapes::quad({1.3, 2.1, 1.2}, {4.7, 2.1, 1.2}, {4.7, 2.1, 4.6}, {1.3, 2.1, 4.6});
  const RefinedCells refined = refinedSheet(sheet);
  const MergedCells merged = mergeSmallCells(refined.cutMesh, refined.cells, MergeOptions{{}, 0.45});
  REQUIRE(merged.cells.cellCount() < refined.cells.cellCount());
  const std::vector<double>& points = refined.cells.cellCentroid;  // cells are convex, or grid cells with slits
  const Flow flow = numbered(refined.cells), flowOfMerged = numbered(merged.cells);
  const std::vector<double> found = velocityAt({sheet, refined.cutMesh, refined.cells, flow}, points),
                            ofMerged = velocityAt({sheet, refined.cutMesh, merged.cells, flowOfMerged}, points);
  for (size_t c = 0; c < refined.cells.cellCount(); ++c) {
    CAPTURE(c, int(refined.cells.cellLevel[c]));
    REQUIRE(found[3 * c] == double(c));
    REQUIRE(ofMerged[3 * c] == double(merged.mergedCell[c]));
  }
  CHECK(std::isnan(velocityAt({sheet, refined.cutMesh, refined.cells, flow}, std::vector<double>{8, 0, 0})[0]));
}

TEST_CASE("refined flow: streamlines along a sheet pass cells of all sizes and are straight", "[refined flow]") {
  const Mesh sheet = shapes::quad({1.3, 2.1, 1.2}, {4.7, 2.1, 1.2}, {4.7, 2.1, 4.6}, {1.3, 2.1, 4.6});
  const RefinedCells refined = refinedSheet(sheet);
  const CellComplex cells = mergeSmallCells(refined.cutMesh, refined.cells).cells;
  const Flow flow = solveFlow(cells, {1, 0, 0});
  REQUIRE(flow.status == SolveStatus::converged);
  const std::vector<double> seeds = {0, 2.05, 2.3, 0, 2.1001, 2.3, 0, 1.6, 3.1, 0, 4.4, 5.2};
  const Streamlines lines = streamlines({sheet, refined.cutMesh, cells, flow}, seeds);
  REQUIRE(lines.ends.size() == 4);
  for (size_t i = 0; i < 4; ++i) {
    REQUIRE(lines.ends[i] == StreamlineEnd::side);
    for (size_t p = lines.offsets[i]; p < lines.offsets[i + 1]; ++p) {
      for (const size_t d : {1, 2}) REQUIRE(lines.points[3 * p + d] == Approx(seeds[3 * i + d]).margin(1e-5));
    }
    CHECK(lines.points[3 * size_t(lines.offsets[i + 1] - 1)] == 7);
  }
}

TEST_CASE("refined flow: streamlines about a ball keep their stream function", "[refined flow]") {
  const Mesh ball = shapes::icosphere({0, 0, 0}, 1, 4);
  RefineOptions options;
  options.levels = 1;
  options.angle = 0;
  options.coarsening.maxLevel = 1;
  const CutResult whole = cut(ball, Grid::box({-3, -3, -3}, {3, 3, 3}, {12, 12, 12}));
  const RefinedCells refined = refineCells(prepare(ball).mesh, whole.mesh, options);
  const CellComplex cells = mergeSmallCells(refined.cutMesh, refined.cells).cells;
  FlowOptions far;
  far.farField = true;
  const Flow flow = solveFlow(cells, {1, 0, 0}, far);
  std::vector<double> seeds;
  for (const double y : {0.5, 0.8, 1.3}) seeds.insert(seeds.end(), {-3, y, 0.1, -3, 0.13, -y});
  const FlowField field{ball, refined.cutMesh, cells, flow};
  const Streamlines lines = streamlines(field, seeds);
  for (size_t i = 0; i < lines.ends.size(); ++i) {
    CAPTURE(i);
    CHECK(lines.ends[i] == StreamlineEnd::side);
    const auto stream = [&](size_t p) {
      const double *at = &lines.points[3 * p], across = at[1] * at[1] + at[2] * at[2], r = std::sqrt(at[0] * at[0] + across);
      return across * (1 - 1 / (r * r * r));
    };
    for (size_t p = lines.offsets[i]; p < lines.offsets[i + 1]; ++p) REQUIRE(stream(p) == Approx(stream(lines.offsets[i])).margin(0.05));
  }
  StreamlineOptions threads;
  threads.threads = 3;
  CHECK(streamlines(field, seeds, threads).points == lines.points);
}
