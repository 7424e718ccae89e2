// Heat in steps: a ball that is hot at first, and whose surface is kept at 0, against the series.
#include "mandoline/heat.h"

#include <cmath>
#include <numbers>

#include "complexes.h"
#include "mandoline/merge.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

constexpr double kRadius = 0.8, kPi = std::numbers::pi, kBegin = 0.04, kEnd = 0.08;
constexpr std::array<double, 3> kCentre = {0.03, 0.02, -0.01};

/// The heat is 1 everywhere at time 0. Steps begin when it is smooth.
double seriesAt(const double* x, double time) {
  double sum = 0;
  const double r = std::hypot(x[0] - kCentre[0], x[1] - kCentre[1], x[2] - kCentre[2]);
  for (int n = 1; n <= 30; ++n) {
    const double w = n * kPi / kRadius;
    sum += (n % 2 ? 2 : -2) * (r > 1e-9 ? std::sin(w * r) / (w * r) : 1) * std::exp(-w * w * time);
  }
  return sum;
}

CellComplex ball(int64_t n, bool isMerged) {
  // Of the ball's volume.
  constexpr double kInscribed = 1.0001807;
  const Mesh mesh = shapes::icosphere({kCentre[0], kCentre[1], kCentre[2]}, kInscribed * kRadius, 5);
  const CutResult result = cut(mesh, Grid::box({-1, -1, -1}, {1, 1, 1}, {n, n, n}));
  REQUIRE(result);
  CoarsenOptions options;
  options.maxLevel = 0;
  CellComplex cells = cellComplex(mesh, result.mesh, coarsen(result.mesh, options));
  if (isMerged) cells = mergeSmallCells(result.mesh, cells).cells;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double* x = &cells.cellCentroid[3 * c];
    if (std::hypot(x[0] - kCentre[0], x[1] - kCentre[1], x[2] - kCentre[2]) < kRadius / 2)
      return regionComplex(cells, cells.cellRegion[c]).cells;
  }
  return {};
}

HeatProblem cooling(const CellComplex& cells, double timeStep) {
  HeatProblem heat;
  heat.problem.boundary = boundaryOf(cells);
  heat.problem.dualPoints = DualPoints::centroids;
  setBoundary(heat.problem.boundary, cells, FaceTag::surface, Condition::dirichlet, 0);
  for (size_t c = 0; c < cells.cellCount(); ++c) heat.phi.push_back(seriesAt(&cells.cellCentroid[3 * c], kBegin));
  heat.timeStep = timeStep;
  return heat;
}

/// At the end: the mean and the largest error.
std::array<double, 2> coolingErrors(int64_t n, bool isMerged, int64_t steps) {
  const CellComplex cells = ball(n, isMerged);
  HeatStepper stepper(cells, cooling(cells, (kEnd - kBegin) / double(steps)));
  for (int64_t i = 0; i < steps; ++i) REQUIRE(stepper.step() == SolveStatus::converged);
  CHECK(stepper.time() == Approx(kEnd - kBegin));
  std::array<double, 2> errors{};
  double volume = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double e = std::fabs(stepper.phi()[c] - seriesAt(&cells.cellCentroid[3 * c], kEnd));
    errors = {errors[0] + e * cells.cellVolume[c], std::max(errors[1], e)};
    volume += cells.cellVolume[c];
  }
  return {errors[0] / volume, errors[1]};
}

}  // namespace

TEST_CASE("heat: a ball that cools, of second order in space", "[heat][steps]") {
  for (const bool isMerged : {false, true}) {
    const auto coarse = coolingErrors(16, isMerged, 8), fine = coolingErrors(32, isMerged, 16);
    CAPTURE(isMerged, coarse, fine);
    CHECK(std::log2(coarse[0] / fine[0]) >= 1.8);
    CHECK(std::log2(coarse[1] / fine[1]) >= 1.8);
  }
}

TEST_CASE("heat: of second order in time", "[heat]") {
  // One wave between two insulated sides decays as the difference equations have it: in 8 and in 16 steps.
  const CellComplex cells = complexOf(shapes::icosphere({9, 9, 9}, 0.5, 0), Grid::box({0, 0, 0}, {1, 1, 1}, {16, 1, 1}));
  const double rate = std::pow(32 * std::sin(kPi / 32), 2);
  std::array<double, 2> errors;
  for (const int i : {0, 1}) {
    HeatProblem heat;
    heat.problem.boundary = boundaryOf(cells);
    for (size_t c = 0; c < cells.cellCount(); ++c) heat.phi.push_back(std::cos(kPi * cells.cellCentre[3 * c]));
    const int steps = 8 << i;
    heat.timeStep = 0.2 / steps;
    HeatStepper stepper(cells, heat);
    for (int s = 0; s < steps; ++s) REQUIRE(stepper.step() == SolveStatus::converged);
    errors[size_t(i)] = std::fabs(stepper.phi()[0] - heat.phi[0] * std::exp(-rate * 0.2));
  }
  CAPTURE(errors);
  CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.15));
}

TEST_CASE("heat: in huge steps nothing overshoots, and it is the steady state at once", "[heat]") {
  const CellComplex cells = ball(12, true);
  HeatStepper stepper(cells, cooling(cells, 1e6));
  REQUIRE(stepper.step() == SolveStatus::converged);
  for (const double phi : stepper.phi()) CHECK(std::fabs(phi) <= 1e-5);
}

TEST_CASE("heat: what is in a closed region stays, and sources add to it", "[heat]") {
  const CellComplex cells = ball(12, true);
  HeatProblem heat = cooling(cells, 0.01);
  setBoundary(heat.problem.boundary, cells, FaceTag::surface, Condition::neumann, 0);
  for (size_t c = 0; c < cells.cellCount(); ++c) heat.phi[c] = cells.cellCentroid[3 * c];
  HeatStepper stepper(cells, heat);
  const auto total = [&](const std::vector<double>& phi) {
    double sum = 0;
    for (size_t c = 0; c < phi.size(); ++c) sum += phi[c] * cells.cellVolume[c];
    return sum;
  };
  double volume = 0;
  for (const double v : cells.cellVolume) volume += v;
  REQUIRE(stepper.step() == SolveStatus::converged);
  CHECK(total(stepper.phi()) == Approx(total(heat.phi)).margin(1e-9));
  stepper.setSource(std::vector<double>(cells.cellCount(), -5));
  REQUIRE(stepper.step() == SolveStatus::converged);
  CHECK(total(stepper.phi()) == Approx(total(heat.phi) + 0.05 * volume).margin(1e-9));
}

TEST_CASE("heat: bad problems are refused by name", "[heat]") {
  const CellComplex cells = ball(8, false);
  HeatProblem heat = cooling(cells, 0);
  CHECK(refusal([&] { HeatStepper(cells, heat); }).first == Status::badOption);
  heat.timeStep = NAN;
  CHECK(refusal([&] { HeatStepper(cells, heat); }).first == Status::badOption);
  heat.timeStep = 1;
  heat.phi[3] = INFINITY;
  CHECK(refusal([&] { HeatStepper(cells, heat); }) == std::pair(Status::badArgument, int64_t(3)));
  heat.phi.pop_back();
  CHECK(refusal([&] { HeatStepper(cells, heat); }) == std::pair(Status::badArgument, int64_t(-1)));
  heat.phi.assign(cells.cellCount(), 1);
  heat.problem.mass.assign(cells.cellCount(), -1e9);
  CHECK(refusal([&] { HeatStepper(cells, heat); }) == std::pair(Status::badArgument, int64_t(0)));
  heat.problem.mass.clear();
  HeatStepper stepper(cells, heat);
  stepper.setSource({1, 2});
  CHECK(refusal([&] { stepper.step(); }).first == Status::badArgument);
}
