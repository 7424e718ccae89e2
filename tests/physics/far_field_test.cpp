// Potential flow in unbounded space: of balls, sheets and several bodies, against what is known and against wide boxes.
#include <algorithm>

#include "case_list.h"
#include "checked_cut.h"
#include "complexes.h"
#include "mandoline/flow.h"
#include "physics/flow_field.h"
#include "refusal.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;
using shapes::Point;
using vectors::operator-;
using vectors::operator*;

namespace {

const std::array<double, 3> kWind = {0.75, -1.25, 0.5};

FlowOptions inFarField() {
  FlowOptions options;
  options.farField = true;
  return options;
}

/// The velocity of a wind about a ball in unbounded space.
Point aboutBall(const Point& wind, const Point& centre, double radius, const Point& at) {
  const Point step = at - centre;
  const double r = vectors::length(step), share = std::pow(radius / r, 3) / 2, along = 3 * vectors::dot(wind, step) / (r * r);
  return wind - share * (along * step - wind);
}

/// The largest differences of the velocities about a ball from those in unbounded space, of the wind: in cells outside, and of the largest
/// speed on the surface.
std::array<double, 2> errorsAboutBall(const Point& centre, const Grid& grid, const FlowOptions& options) {
  const CellComplex cells = complexOf(shapes::icosphere(centre, 1, 4), grid, 3, 1);
  const Flow flow = solveFlow(cells, kWind, options);
  CHECK(flow.status == SolveStatus::converged);
  const double speed = vectors::length(kWind);
  std::array<double, 2> result{};
  for (uint32_t c = 0; c < cells.cellCount(); ++c) {
    const Point at = vectors::pointAt(cells.cellCentroid, c);
    if (cells.cellRegion[c] != cells.cellRegion.back()) continue;
    const Point error = vectors::pointAt(flow.cellVelocity, c) - aboutBall(kWind, centre, 1, at);
    result[0] = std::max(result[0], vectors::length(error) / speed);
  }
  double fastest = 0;
  for (uint32_t h = 0; h < cells.faceCells.size(); ++h) {
    const int32_t c = cells.faceCells[h];
    if (cells.faceTag[h / 2] != FaceTag::surface || c < 0 || cells.cellRegion[size_t(c)] != cells.cellRegion.back()) continue;
    fastest = std::max(fastest, vectors::length(physics::velocityIn(cells, flow, size_t(c), &cells.faceCentroid[3 * size_t(h / 2)])));
  }
  result[1] = std::fabs(fastest / speed - 1.5);
  return result;
}

/// The largest difference between the velocities in a box with the far field and those in the middle of a wind tunnel five times as wide,
/// of the wind, where both have the same cells.
double errorBesideWideTunnel(const Mesh& mesh, int64_t half, double spacing, const FlowOptions& options) {
  const auto boxOf = [&](int64_t n) {
    const double x = double(n) * spacing;
    return Grid::box({-x, -x, -x}, {x, x, x}, {2 * n, 2 * n, 2 * n});
  };
  const CellComplex near = complexOf(mesh, boxOf(half)), wide = complexOf(mesh, boxOf(5 * half), 24, 2 * int(half));
  const Flow flow = solveFlow(near, kWind, options), expected = solveFlow(wide, kWind);
  CHECK(flow.status == SolveStatus::converged);
  REQUIRE(near.cutCells == wide.cutCells);
  double most = 0;
  for (uint32_t c = 0; c < near.cutCells; ++c) {
    const Point error = vectors::pointAt(flow.cellVelocity, c) - vectors::pointAt(expected.cellVelocity, c);
    most = std::max(most, vectors::length(error) / vectors::length(kWind));
  }
  return most;
}

/// What flows out of the box, of all that passes its sides.
double netOutflow(const CellComplex& cells, const Flow& flow) {
  double net = 0, all = 0;
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    if (cells.faceTag[f] >= FaceTag::inner) continue;
    const double through = flow.faceVelocity[f] * cells.faceArea[f];
    net += cells.faceCells[2 * f] >= 0 ? through : -through;
    all += std::fabs(through);
  }
  return all > 0 ? std::fabs(net) / all : 0;
}

bool reachesSide(const CellComplex& cells) {
  std::vector<char> isOnSide(cells.vertexCount());
  const auto vertices = [&](size_t f) {
    const uint32_t first = cells.loopOffsets[cells.faceLoopOffsets[f]], last = cells.loopOffsets[cells.faceLoopOffsets[f + 1]];
    return std::span(cells.loopVertices).subspan(first, last - first);
  };
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    if (cells.faceTag[f] >= FaceTag::inner) continue;
    for (const uint32_t v : vertices(f)) isOnSide[v] = 1;
  }
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    if (cells.faceTag[f] != FaceTag::surface) continue;
    for (const uint32_t v : vertices(f)) {
      if (isOnSide[v]) return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("far field: about a ball that keeps half its diameter from the sides, speeds are less than 2 % off", "[flow][far_field]") {
  const Mesh ball = shapes::icosphere({0, 0, 0}, 1, 4);
  const Grid grid = Grid::around(ball, 32, 0.5);
  const auto [inCells, onSurface] = errorsAboutBall({0, 0, 0}, grid, inFarField());
  CHECK(inCells <= 0.02);
  CHECK(onSurface <= 0.02 * 1.5);
  const auto [tunnelInCells, tunnelOnSurface] = errorsAboutBall({0, 0, 0}, grid, {});
  CHECK(tunnelInCells >= 0.08);
  CHECK(tunnelOnSurface >= 0.08 * 1.5);
}

TEST_CASE("far field: the same where the ball is nearer to some sides than to others", "[flow][far_field]") {
  const auto [inCells, onSurface] = errorsAboutBall({0.6, -0.5, 0.3}, Grid::box({-2, -2, -2}, {2, 2, 2}, {32, 32, 32}), inFarField());
  CHECK(inCells <= 0.02);
  CHECK(onSurface <= 0.02 * 1.5);
}

TEST_CASE("far field: two bodies, open sheets and long ones flow as in a wide tunnel", "[flow][far_field]") {
  const Mesh balls = shapes::merged({shapes::icosphere({-0.45, -0.5, -0.4}, 0.5, 3), shapes::icosphere({0.6, 0.55, 0.6}, 0.35, 3)});
  const Mesh sheet = shapes::quad({-0.7, -0.8, 0.33}, {0.8, -0.7, 0.31}, {0.75, 0.7, -0.42}, {-0.8, 0.75, -0.37});
  const Mesh rod = shapes::merged(
      {shapes::icosphere({-0.8, 0.02, 0.03}, 0.21, 3), shapes::quad({-0.8, 0, 0}, {0.9, 0.02, 0}, {0.9, 0.02, 0.3}, {-0.8, 0, 0.3})});
  for (const Mesh& mesh : {balls, sheet, rod}) {
    const double error = errorBesideWideTunnel(mesh, 8, 0.2, inFarField()), tunnel = errorBesideWideTunnel(mesh, 8, 0.2, {});
    CAPTURE(error, tunnel);
    CHECK(error <= 0.01);
    CHECK(error <= tunnel / 3);
  }
}

TEST_CASE("far field: as much flows into the box and into every cell as out of it; walls that reach a side are refused",
          "[flow][far_field]") {
  size_t refused = 0, solved = 0;
  for (const NamedCase& c : casesAndSoups()) {
    CAPTURE(c.name);
    const CellComplex cells = complexOf(c.mesh, c.grid, 24);
    FlowOptions options = inFarField();
    options.tolerance = 1e-12;
    if (reachesSide(cells)) {
      ++refused;
      const auto [status, face] = refusal([&] { solveFlow(cells, kWind, options); });
      CHECK(status == Status::badArgument);
      REQUIRE((face >= 0 && size_t(face) < cells.faceCount()));
      CHECK(cells.faceTag[size_t(face)] == FaceTag::surface);
      continue;
    }
    ++solved;
    const Flow flow = solveFlow(cells, kWind, options);
    CHECK(flow.status == SolveStatus::converged);
    CHECK(flow.throttled.empty());
    CHECK(netOutflow(cells, flow) <= 1e-14);
    const double size = sizeOf(cells);
    CHECK(largest(divergence(cells) * vectorOf(flow.faceVelocity)) <= 1e-10 * size * size);
    for (size_t f = 0; f < cells.faceCount(); ++f) {
      if (cells.faceTag[f] == FaceTag::surface) REQUIRE(flow.faceVelocity[f] == 0);
    }
    for (const double v : flow.cellVelocity) REQUIRE(std::isfinite(v));
  }
  CHECK(refused > 5);
  CHECK(solved > 5);
}

TEST_CASE("far field: a surface that is exactly as large as the box is refused", "[flow][far_field]") {
  for (const int cells : {1, 4}) {
    const CellComplex complex = complexOf(shapes::cube(0, cells), unitGrid(cells));
    const auto [status, face] = refusal([&] { solveFlow(complex, kWind, inFarField()); });
    CHECK(status == Status::badArgument);
    REQUIRE((face >= 0 && size_t(face) < complex.faceCount()));
    CHECK(complex.faceTag[size_t(face)] == FaceTag::surface);
  }
}

TEST_CASE("far field: nothing in the wind and a plate edge-on change nothing", "[flow][far_field]") {
  const Mesh plate = shapes::quad({1.5, 1.5, 2.5}, {4.5, 1.5, 2.5}, {4.5, 4.5, 2.5}, {1.5, 4.5, 2.5});
  for (const Mesh& mesh : {shapes::cube(100, 101), plate}) {
    const CellComplex cells = complexOf(mesh, unitGrid(6));
    FlowOptions options = inFarField();
    options.tolerance = 1e-13;
    const Flow flow = solveFlow(cells, {1, 0.5, 0}, options);
    CHECK(flow.status == SolveStatus::converged);
    const std::array<double, 3> wind = {1, 0.5, 0};
    const double limit = mesh.triangles.size() == plate.triangles.size() ? 1e-4 : 1e-10;  // dipoles agree that well
    for (size_t i = 0; i < flow.cellVelocity.size(); ++i) REQUIRE(std::fabs(flow.cellVelocity[i] - wind[i % 3]) <= limit);
  }
}

TEST_CASE("far field: converges also where the wind hardly gets past", "[flow][far_field]") {
  const Mesh plate = shapes::quad({0.01, -1, -1}, {0.01, 1, -1}, {0.01, 1, 1}, {0.01, -1, 1});
  const CellComplex cells = complexOf(plate, Grid::around(plate, 24, 0.02));
  const Flow flow = solveFlow(cells, {1, 0, 0}, inFarField()), tunnel = solveFlow(cells, {1, 0, 0});
  CHECK(flow.status == SolveStatus::converged);
  const auto fastest = [](const Flow& of) { return *std::max_element(of.cellVelocity.begin(), of.cellVelocity.end()); };
  CHECK(fastest(flow) < fastest(tunnel) / 2);
}

TEST_CASE("far field: the same bits for any number of threads", "[flow][far_field]") {
  const CellComplex cells = complexOf(shapes::icosphere({9.3, 9.1, 8.9}, 4.7, 2), unitGrid(19));  // of which each thread has several blocks
  FlowOptions options = inFarField();
  options.threads = 1;
  const Flow expected = solveFlow(cells, kWind, options);
  options.threads = 3;
  const Flow flow = solveFlow(cells, kWind, options);
  CHECK(flow.phi == expected.phi);
  CHECK(flow.cellVelocity == expected.cellVelocity);
}

TEST_CASE("far field: in any unit of length, for any wind", "[flow][far_field]") {
  const auto flowIn = [](double unit, const std::array<double, 3>& wind) {
    const Mesh mesh = shapes::icosphere({3.3 * unit, 3.1 * unit, 2.9 * unit}, 1.7 * unit, 2);
    return solveFlow(complexOf(mesh, Grid::box({0, 0, 0}, {7 * unit, 7 * unit, 7 * unit}, {7, 7, 7})), wind, inFarField());
  };
  const Flow expected = flowIn(1, kWind);
  CHECK(flowIn(1, {2 * kWind[0], 2 * kWind[1], 2 * kWind[2]}).cellPressure == expected.cellPressure);
  for (const double unit : {1e-65, 1e65}) {
    const Flow flow = flowIn(unit, kWind);
    CHECK(flow.status == SolveStatus::converged);
    for (size_t i = 0; i < flow.cellVelocity.size(); ++i) REQUIRE(std::fabs(flow.cellVelocity[i] - expected.cellVelocity[i]) <= 1e-8);
  }
  const Flow still = flowIn(1, {0, 0, 0});
  CHECK(still.status == SolveStatus::converged);
  CHECK(still.cellVelocity == std::vector<double>(still.cellVelocity.size()));
}

TEST_CASE("far field: progress grows, and cancels; limits are kept", "[flow][far_field]") {
  const CellComplex cells = complexOf(shapes::icosphere({6.3, 6.1, 5.9}, 3.7, 2), unitGrid(13));
  FlowOptions options = inFarField();
  int stage = 0;
  size_t done = 0;
  options.progress = [&](const Progress& p) {
    CHECK(p.stageCount == 3);
    CHECK(p.stageIndex >= stage);
    CHECK((p.stageIndex > stage || p.stageIndex != 1 || p.done >= done));
    stage = p.stageIndex, done = p.done;
    return true;
  };
  const Flow flow = solveFlow(cells, kWind, options);
  CHECK(stage == 2);
  CHECK(flow.residuals.back() <= options.tolerance);
  options.progress = [](const Progress& p) { return p.stageIndex != 1 || p.done < 600; };
  CHECK(refusal([&] { solveFlow(cells, kWind, options); }).first == Status::cancelled);
  options.progress = {};
  options.maxIterations = 1;
  CHECK(solveFlow(cells, kWind, options).status == SolveStatus::iterationLimit);
  options.tolerance = -1;
  CHECK(refusal([&] { solveFlow(cells, kWind, options); }).first == Status::badOption);
}
