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
