// Fits in the midst of a uniform grid, whose weights are found once.
#include "physics/uniform_fits.h"

#include "complexes.h"
#include "physics/cell_edges.h"
#include "shapes.h"

using namespace mandoline;

namespace {

/// 20 x 20 x 20 cells; `steps`: their sides.
Grid gridOf(const std::array<double, 3>& steps) {
  Grid grid;
  for (size_t d = 0; d < 3; ++d) {
    for (int i = 0; i <= 20; ++i) grid.planes[d].push_back(steps[d] * i);
  }
  return grid;
}

struct Compared {
  size_t uniform = 0;  ///< cells
  double difference = 0, largest = 0;
};

/// Of both ways to fit, on all cells.
Compared compare(const CellComplex& cells, bool hasSource, unsigned threads) {
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  std::vector<double> phi;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double* x = &cells.cellCentre[3 * c];
    phi.push_back(100 + std::sin(0.3 * x[0] + 0.2 * x[1] * x[2]) + x[0] * x[1] - 0.5 * x[2] * x[2]);
    if (hasSource) problem.source.push_back(std::cos(0.1 * x[0] + x[1]));
  }
  const physics::DualEdges dual = physics::dualEdges(cells, problem.dualPoints);
  const detail::Csr<uint32_t> edges = physics::cellEdges(cells, dual, threads);
  const physics::FitSource source{cells, dual, edges, problem};
  const physics::UniformFits uniform(source, threads);
  std::vector<uint32_t> all;
  for (uint32_t c = 0; c < cells.cellCount(); ++c) all.push_back(c);
  const physics::FitData data = physics::fitData(source, nullptr, {}, threads);
  const RunOptions quiet{threads, {}};
  detail::Monitor monitor(quiet, 1);
  physics::CellFits expected(cells.cellCount(), threads);
  physics::fitCells(all, {cells, data, physics::fitValues(source, data, phi, threads), problem.source}, monitor, expected);
  physics::CellFits found = expected;
  uniform.fit(phi, threads, found);
  Compared result{cells.cellCount() - uniform.otherCells().size()};
  const auto add = [&](const std::vector<double>& a, const std::vector<double>& b) {
    for (size_t i = 0; i < a.size(); ++i) {
      result.largest = std::max(result.largest, std::fabs(b[i]));
      result.difference = std::max(result.difference, std::fabs(a[i] - b[i]));
    }
  };
  add(found.gradient, expected.gradient);
  add(found.second, expected.second);
  return result;
}

}  // namespace

TEST_CASE("uniform fits: as cell by cell, on grids of cubes and of other boxes, with sources and without", "[flow]") {
  for (const std::array<double, 3>& steps : {std::array<double, 3>{1, 1, 1}, {0.1, 0.3, 0.7}}) {
    const CellComplex cells = complexOf(shapes::icosphere({4 * steps[0], 5 * steps[1], 4 * steps[2]}, 2.3 * steps[0], 1), gridOf(steps));
    for (const bool hasSource : {false, true}) {
      const Compared compared = compare(cells, hasSource, 3);
      CHECK(compared.uniform > cells.cellCount() / 3);
      CHECK(compared.difference < 1e-11 * compared.largest);
    }
  }
}

TEST_CASE("uniform fits: in octree cells of all sizes", "[flow]") {
  Grid grid = gridOf({1, 1, 1});
  for (size_t d = 0; d < 3; ++d) {
    for (int i = 21; i <= 64; ++i) grid.planes[d].push_back(i);
  }
  const CellComplex cells = complexOf(shapes::icosphere({6, 6, 6}, 3.3, 1), grid, 3, 4);
  const Compared compared = compare(cells, true, 1);
  CHECK(compared.uniform > 0);
  CHECK(compared.uniform < cells.cellCount());
  CHECK(compared.difference < 1e-11 * compared.largest);
}

TEST_CASE("uniform fits: none where planes are at other distances", "[flow]") {
  Grid grid = gridOf({1, 1, 1});
  for (size_t i = 11; i <= 20; ++i) grid.planes[1][i] += 0.25 * double(i - 10) * double(i - 10);
  const CellComplex cells = complexOf(shapes::icosphere({4, 5, 4}, 2.3, 1), grid);
  const Compared compared = compare(cells, false, 1);
  CHECK(compared.uniform > 0);
  CHECK(compared.difference < 1e-11 * compared.largest);
  for (size_t d = 0; d < 3; ++d) {
    for (size_t i = 0; i <= 20; ++i) grid.planes[d][i] = double(i) + 0.01 * double(i * i);
  }
  CHECK(compare(complexOf(shapes::icosphere({4, 5, 4}, 2.3, 1), grid), false, 1).uniform == 0);
}
