// Potential flow: through an empty box, about bodies and sheets, in closed and blocked regions.
#include "mandoline/flow.h"

#include "case_list.h"
#include "checked_cut.h"
#include "complexes.h"
#include "physics/flow_field.h"
#include "physics/flow_of_phi.h"
#include "refusal.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;

namespace {

const std::array<double, 3> kWind = {0.75, -1.25, 0.5};

/// The largest sum of what flows out of a cell.
double largestDivergence(const CellComplex& cells, const Flow& flow) { return largest(divergence(cells) * vectorOf(flow.faceVelocity)); }

/// The largest difference from a velocity, in cells, on faces between them and in gradients.
double differenceFrom(const std::array<double, 3>& velocity, const CellComplex& cells, const Flow& flow) {
  double most = 0;
  for (size_t i = 0; i < flow.cellVelocity.size(); ++i) most = std::max(most, std::fabs(flow.cellVelocity[i] - velocity[i % 3]));
  for (const double g : flow.cellGradient) most = std::max(most, std::fabs(g));
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    if (cells.faceTag[f] != FaceTag::surface) most = std::max(most, std::fabs(flow.faceVelocity[f] - dot(velocity, cells.faceNormal, f)));
  }
  return most;
}

FlowOptions within(double tolerance) {
  FlowOptions options;
  options.tolerance = tolerance;
  return options;
}

/// A sheet z = 2.5, from x = y = a to b.
Mesh plate(double a, double b) { return shapes::quad({a, a, 2.5}, {b, a, 2.5}, {b, b, 2.5}, {a, b, 2.5}); }

/// The largest speeds of a wind along x about the unit sphere in a wide box: in cells, and on the surface.
std::array<double, 2> largestSpeeds() {
  const CellComplex all = complexOf(shapes::icosphere({0, 0, 0}, 1, 4), Grid::box({-5, -5, -5}, {5, 5, 5}, {80, 80, 80}), 5, 3);
  const CellComplex cells = regionComplex(all, all.cellRegion.back()).cells;
  const Flow flow = solveFlow(cells, {1, 0, 0});
  std::array<double, 2> result{};
  for (size_t c = 0; c < cells.cellCount(); ++c)
    result[0] = std::max(result[0], vectors::length(vectors::pointAt(flow.cellVelocity, uint32_t(c))));
  for (size_t h = 0; h < cells.faceCells.size(); ++h) {
    if (cells.faceTag[h / 2] != FaceTag::surface || cells.faceCells[h] < 0) continue;
    const auto v = physics::velocityIn(cells, flow, size_t(cells.faceCells[h]), &cells.faceCentroid[3 * (h / 2)]);
    result[1] = std::max(result[1], vectors::length(v));
  }
  return result;
}

}  // namespace

TEST_CASE("flow: in an empty box the wind blows on, also through octree cells", "[flow]") {
  for (const int maxLevel : {0, 24}) {
    const CellComplex cells = complexOf(shapes::cube(100, 101), unitGrid(9, 6, 7), maxLevel);
    const Flow flow = solveFlow(cells, kWind, within(1e-13));
    CHECK(flow.status == SolveStatus::converged);
    CHECK(flow.throttled.empty());
    CHECK(differenceFrom(kWind, cells, flow) <= 1e-10);
    CHECK(std::fabs(flow.phi.back() - flow.phi.front() - dot(kWind, cells.cellCentre, cells.cellCount() - 1) +
                    dot(kWind, cells.cellCentre, 0)) <= 1e-11);
    for (const double pressure : flow.cellPressure) REQUIRE(std::fabs(pressure) <= 1e-10);
  }
}

TEST_CASE("flow: as much into every cell as out of it, nothing through the surface, in all cases", "[flow]") {
  for (const NamedCase& c : caseList()) {
    for (const int maxLevel : {0, 24}) {
      CAPTURE(c.name, maxLevel);
      const CellComplex cells = complexOf(c.mesh, c.grid, maxLevel);
      const Flow flow = solveFlow(cells, kWind, within(1e-12));
      REQUIRE(flow.status == SolveStatus::converged);
      const double size = sizeOf(cells);
      CHECK(largestDivergence(cells, flow) <= 1e-10 * size * size);
      for (size_t f = 0; f < cells.faceCount(); ++f) {
        if (cells.faceTag[f] == FaceTag::surface) REQUIRE(flow.faceVelocity[f] == 0);
      }
      for (const double v : flow.cellVelocity) REQUIRE(std::isfinite(v));
    }
  }
}

TEST_CASE("flow: about a ball the wind is half as fast again at the equator, and at rest inside", "[flow]") {
  for (const double speed : largestSpeeds()) CHECK(std::fabs(speed - 1.5) <= 0.045);
  const CellComplex cells = complexOf(shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2), unitGrid(7));
  const Flow flow = solveFlow(cells, kWind);
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    if (cells.cellRegion[c] == cells.cellRegion.back()) continue;
    REQUIRE(std::fabs(flow.cellVelocity[3 * c]) + std::fabs(flow.cellVelocity[3 * c + 1]) + std::fabs(flow.cellVelocity[3 * c + 2]) <=
            1e-12);
    REQUIRE(flow.cellPressure[c] == Approx(1));
  }
}

TEST_CASE("flow: a plate edge-on changes nothing, broadside the wind goes round it", "[flow]") {
  const CellComplex cells = complexOf(plate(1.5, 4.5), unitGrid(6));
  CHECK(differenceFrom({1, 0.5, 0}, cells, solveFlow(cells, {1, 0.5, 0}, within(1e-13))) <= 1e-10);
  const Flow broadside = solveFlow(cells, {0, 0, 1});
  CHECK(largestDivergence(cells, broadside) <= 1e-8);
  size_t beside = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) {  // cells beside the plate's middle
    const int32_t* at = &cells.cellCorner[3 * c];
    if (at[0] < 2 || at[0] > 3 || at[1] < 2 || at[1] > 3 || at[2] != 2) continue;
    ++beside;
    const double toPlate = 2.5 - cells.cellCentroid[3 * c + 2];
    CHECK(std::fabs(broadside.cellVelocity[3 * c + 2] + toPlate * broadside.cellGradient[6 * c + 2]) <= 0.05);
  }
  CHECK(beside == 8);
}

TEST_CASE("flow: a sheet across the box is a dead end, one with a slope throttles", "[flow]") {
  const CellComplex halves = complexOf(plate(-1, 9), unitGrid(5));
  const Flow blocked = solveFlow(halves, {0, 0, 1});
  CHECK(blocked.status == SolveStatus::converged);
  CHECK(blocked.throttled == std::vector<uint32_t>{0, 1});
  CHECK(differenceFrom({0, 0, 0}, halves, blocked) <= 1e-14);
  const Flow along = solveFlow(halves, {1, 0, 0}, within(1e-13));
  CHECK(along.throttled.empty());
  CHECK(differenceFrom({1, 0, 0}, halves, along) <= 1e-10);
  // Oblique: each half takes in on more sides than it gives away on, or fewer.
  const Flow oblique = solveFlow(halves, {1, 0, 1});
  CHECK(oblique.status == SolveStatus::converged);
  CHECK(oblique.throttled.size() == 2);
  for (const double u : oblique.faceVelocity) REQUIRE(std::fabs(u) <= 1.5);
  CHECK(largestDivergence(halves, oblique) <= 1e-8);
}

TEST_CASE("flow: no wind comes into slivers that it can't leave but through slits", "[flow]") {
  // Its edges lie in the sides of its box.
  const Mesh prism{{20, -20, 0, -20, -20, 0, 20, 20, 0, 20, -20, 10, -20, -20, 10, 20, 20, 10},
                   {0, 1, 2, 3, 1, 0, 1, 3, 4, 5, 4, 3, 2, 3, 0, 3, 2, 5, 2, 4, 1, 4, 2, 5}};
  const CellComplex cells = complexOf(prism, Grid::around(prism, 12, 0));
  for (const std::array<double, 3>& wind : {std::array{1.0, 0.0, 0.0}, std::array{0.0, 1.0, 0.0}, std::array{0.0, 0.0, 1.0}}) {
    const Flow flow = solveFlow(cells, wind);
    CHECK(flow.status == SolveStatus::converged);
    CHECK(largestDivergence(cells, flow) <= 1e-8);
    for (const double u : flow.faceVelocity) REQUIRE(std::fabs(u) <= 10);
  }
}

TEST_CASE("flow: in any unit of length that doubles can compute in; never numbers that are not finite", "[flow]") {
  const auto flowIn = [](double unit) {
    const Mesh mesh = shapes::icosphere({3.3 * unit, 3.1 * unit, 2.9 * unit}, 1.7 * unit, 2);
    return solveFlow(complexOf(mesh, Grid::box({0, 0, 0}, {7 * unit, 7 * unit, 7 * unit}, {7, 7, 7})), kWind);
  };
  const Flow expected = flowIn(1);
  for (const double unit : {1e-65, 1e65}) {
    const Flow flow = flowIn(unit);
    CHECK(flow.status == SolveStatus::converged);
    for (size_t i = 0; i < flow.cellVelocity.size(); ++i) REQUIRE(std::fabs(flow.cellVelocity[i] - expected.cellVelocity[i]) <= 1e-8);
  }
  for (const double unit : {1e-150, 1e-80, 1e80, 1e150}) CHECK(refusal([&] { flowIn(unit); }).first == Status::badArgument);
  CHECK(solveFlow(complexOf(shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2), unitGrid(7)), {1.7e308, 0, 0}).status == SolveStatus::breakdown);
}

TEST_CASE("flow: twice the wind, twice the flow; no wind, no flow; any magnitude", "[flow]") {
  const CellComplex cells = complexOf(shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2), unitGrid(7));
  const Flow once = solveFlow(cells, kWind), still = solveFlow(cells, {0, 0, 0}), storm = solveFlow(cells, {1e300, 0, 0});
  const Flow twice = solveFlow(cells, {2 * kWind[0], 2 * kWind[1], 2 * kWind[2]});
  CHECK(once.cellPressure == twice.cellPressure);
  for (size_t i = 0; i < once.cellVelocity.size(); ++i) REQUIRE(2 * once.cellVelocity[i] == twice.cellVelocity[i]);
  CHECK(still.status == SolveStatus::converged);
  CHECK(still.cellVelocity == std::vector<double>(3 * cells.cellCount()));
  CHECK(still.cellPressure == std::vector<double>(cells.cellCount()));
  CHECK(storm.status == SolveStatus::converged);
  CHECK(storm.cellPressure == solveFlow(cells, {1, 0, 0}).cellPressure);
}

TEST_CASE("flow: velocities by polynomials that the solver has made are those made anew, also in octree cells and beside them", "[flow]") {
  const CellComplex all = complexOf(shapes::icosphere({0.1, 0.05, -0.02}, 1, 3), Grid::box({-4, -4, -4}, {4, 4, 4}, {32, 32, 32}), 24, 1);
  const CellComplex cells = regionComplex(all, all.cellRegion.back()).cells;
  const Flow flow = solveFlow(cells, kWind), anew = physics::flowOfPhi(cells, kWind, flow.phi, {}, {});
  REQUIRE(flow.status == SolveStatus::converged);
  CHECK(*std::max_element(cells.cellLevel.begin(), cells.cellLevel.end()) >= 2);
  CHECK(largest(vectorOf(flow.cellVelocity) - vectorOf(anew.cellVelocity)) <= 1e-11);
  CHECK(largest(vectorOf(flow.cellGradient) - vectorOf(anew.cellGradient)) <= 1e-9);
}

TEST_CASE("flow: the same bits on any number of threads where there are cells for them, also octree cells", "[flow]") {
  const int maxLevel = GENERATE(0, 1);
  const double scale = maxLevel + 1;
  const CellComplex cells =
      complexOf(shapes::icosphere({13.3 * scale, 13.1 * scale, 12.9 * scale}, 4.7, 2), unitGrid(27 * (maxLevel + 1)), maxLevel);
  REQUIRE(std::count(cells.cellLevel.begin(), cells.cellLevel.end(), maxLevel) > 18'000);
  FlowOptions options;
  options.threads = 1;
  const Flow one = solveFlow(cells, kWind, options);
  CHECK(one.status == SolveStatus::converged);
  for (const unsigned threads : {2u, 3u}) {
    options.threads = threads;
    const Flow more = solveFlow(cells, kWind, options);
    CHECK(more.phi == one.phi);
    CHECK(more.cellVelocity == one.cellVelocity);
    CHECK(more.cellGradient == one.cellGradient);
  }
}

TEST_CASE("flow: the same bits for any number of threads; progress, cancelling and wrong options", "[flow]") {
  const CellComplex cells = complexOf(shapes::icosphere({6.3, 6.1, 5.9}, 3.7, 2), unitGrid(13));
  FlowOptions options;
  options.threads = 1;
  const Flow one = solveFlow(cells, kWind, options);
  options.threads = 3;
  int last = 0;
  options.progress = [&](const Progress& p) {
    CHECK(p.stageCount == 3);
    CHECK(p.stageIndex >= last);
    last = p.stageIndex;
    return true;
  };
  const Flow three = solveFlow(cells, kWind, options);
  CHECK(last == 2);
  CHECK(one.cellVelocity == three.cellVelocity);
  CHECK(one.cellGradient == three.cellGradient);
  for (int stage = 0; stage < 3; ++stage) {
    options.progress = [&](const Progress& p) {
      if (p.stageIndex == stage) throw std::runtime_error("mine");
      return true;
    };
    CHECK_THROWS_AS(solveFlow(cells, kWind, options), std::runtime_error);
  }
  options.progress = [](const Progress& p) { return p.stageIndex < 2; };
  CHECK(refusal([&] { solveFlow(cells, kWind, options); }).first == Status::cancelled);
  options = {};
  CHECK(refusal([&] { solveFlow(cells, {NAN, 0, 0}, options); }).first == Status::badArgument);
  CHECK(refusal([&] { solveFlow(cells, {0, NAN, 0}, options); }).first == Status::badArgument);
  CHECK(refusal([&] { solveFlow(cells, {0, 0, INFINITY}, options); }).first == Status::badArgument);
  options.tolerance = 0;
  CHECK(refusal([&] { solveFlow(cells, kWind, options); }).first == Status::badOption);
  options.tolerance = 1e-10, options.maxIterations = 1;
  CHECK(solveFlow(cells, kWind, options).status == SolveStatus::iterationLimit);
}
