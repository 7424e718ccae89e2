// Computing on merged cells: fluxes balance, and points and lines find their cells by the members.
#include <cmath>

#include "catch.h"
#include "mandoline/flow.h"
#include "mandoline/mandoline.h"
#include "shapes.h"

using namespace mandoline;

namespace {

struct Case {
  Mesh mesh;
  CutMesh cutMesh;
  CellComplex before;
  MergedCells merged;
};

Case caseOf(Mesh mesh, int maxLevel) {
  Case c{std::move(mesh), {}, {}, {}};
  c.cutMesh = cut(c.mesh, Grid::regular({0, 0, 0}, {1, 1, 1}, {12, 11, 10})).mesh;
  CoarsenOptions options;
  options.maxLevel = maxLevel;
  c.before = cellComplex(c.mesh, c.cutMesh, coarsen(c.cutMesh, options));
  c.merged = mergeSmallCells(c.cutMesh, c.before);
  REQUIRE(c.merged.cells.cellCount() < c.before.cellCount());
  return c;
}

Mesh ball() { return shapes::icosphere({6.1, 5.2, 5.3}, 2.3, 3); }

/// A sheet that small cells lie below.
Mesh sheet() {
  return shapes::sheet(3, 3, [](int i, int j) { return shapes::Point{3.3 + 1.9 * i, 2.6 + 1.8 * j, 5.03 + 0.02 * i}; });
}

}  // namespace

TEST_CASE("merged cells: what flows into a cell flows out of it", "[flow]") {
  for (const int maxLevel : {0, 2}) {
    for (const Mesh& mesh : {ball(), sheet()}) {
      const Case c = caseOf(mesh, maxLevel);
      const CellComplex& cells = c.merged.cells;
      const Flow flow = solveFlow(cells, {1, 0.5, 0.25});
      REQUIRE(flow.status == SolveStatus::converged);
      double largest = 0;
      for (size_t k = 0; k < cells.cellCount(); ++k) {
        double out = 0;
        for (const uint32_t h : cells.halfFaces(k)) out += (h % 2 ? -1 : 1) * flow.faceVelocity[h / 2] * cells.faceArea[h / 2];
        largest = std::max(largest, std::fabs(out));
      }
      CHECK(largest < 1e-8);
    }
  }
}

TEST_CASE("merged cells: the velocity at a point is that of the cell which its member belongs to", "[flow]") {
  for (const int maxLevel : {0, 2}) {
    const Case c = caseOf(ball(), maxLevel);
    const CellComplex& cells = c.merged.cells;
    Flow flow = solveFlow(cells, {1, 0, 0});
    for (size_t k = 0; k < cells.cellCount(); ++k) {
      for (size_t d = 0; d < 3; ++d) flow.cellVelocity[3 * k + d] = double(k);
      for (size_t i = 0; i < 6; ++i) flow.cellGradient[6 * k + i] = 0;
    }
    std::vector<double> points;
    std::vector<uint32_t> expected;
    const Locations found = cellsAt(c.cutMesh, c.before.cellCentroid);
    for (uint32_t b = 0; b < c.before.cellCount(); ++b) {
      if (b < c.before.cutCells && found.cell[b] != int64_t(b)) continue;  // the centroid lies elsewhere
      points.insert(points.end(), &c.before.cellCentroid[3 * b], &c.before.cellCentroid[3 * b] + 3);
      expected.push_back(c.merged.mergedCell[b]);
    }
    REQUIRE(expected.size() > c.before.cellCount() / 2);
    const std::vector<double> velocities = velocityAt({c.mesh, c.cutMesh, cells, flow}, points);
    for (size_t i = 0; i < expected.size(); ++i) REQUIRE(velocities[3 * i] == double(expected[i]));
  }
}

TEST_CASE("merged cells: streamlines pass around what is there, and leave the grid", "[flow]") {
  for (const int maxLevel : {0, 2}) {
    for (const Mesh& mesh : {ball(), sheet()}) {
      const Case c = caseOf(mesh, maxLevel);
      const std::array<double, 3> wind{1, 0, 0};
      const Flow flow = solveFlow(c.merged.cells, wind);
      const Streamlines lines = streamlines({c.mesh, c.cutMesh, c.merged.cells, flow}, inflowSeeds(c.cutMesh.grid, wind, 200));
      const auto leaving = std::count(lines.ends.begin(), lines.ends.end(), StreamlineEnd::side);
      CHECK(leaving > 180);
    }
  }
}

TEST_CASE("merged cells: members that are not the cut-mesh's are refused", "[flow]") {
  const Case c = caseOf(ball(), 2);
  const Flow flow = solveFlow(c.merged.cells, {1, 0, 0});
  const std::vector<double> point{1.5, 1.5, 1.5};
  for (const uint32_t wrong : {0u, 1u << 20}) {
    CellComplex cells = c.merged.cells;
    cells.cellMembers.back() = wrong;
    CHECK_THROWS_AS(velocityAt({c.mesh, c.cutMesh, cells, flow}, point), CallError);
  }
}
