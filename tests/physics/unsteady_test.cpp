// Incompressible flow in steps: against exact solutions, what it does to the surface, and that it stays bounded.
#include "mandoline/unsteady.h"

#include <cmath>
#include <numbers>

#include "complexes.h"
#include "mandoline/io.h"
#include "mandoline/merge.h"
#include "mesh_folder.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

constexpr double kPi = std::numbers::pi;

Mesh nothing() { return shapes::icosphere({99, 99, 99}, 0.5, 0); }

CellComplex mergedCells(const Mesh& mesh, const Grid& grid, bool isCoarsened = false) {
  const CutResult result = cut(mesh, grid);
  REQUIRE(result);
  CoarsenOptions options;
  if (!isCoarsened) options.maxLevel = 0;
  const CellComplex cells = cellComplex(mesh, result.mesh, coarsen(result.mesh, options));
  return uniteWalls(result.mesh, mergeSmallCells(result.mesh, cells).cells);
}

/// Per cell: what flows out of it.
std::vector<double> outflows(const CellComplex& cells, const UnsteadyFlow& flow) {
  std::vector<double> result(cells.cellCount());
  for (size_t h = 0; h < cells.faceCells.size(); ++h) {
    const double flux = (h % 2 == 0 ? 1 : -1) * flow.faceVelocity[h / 2] * cells.faceArea[h / 2];
    if (cells.faceCells[h] >= 0) result[size_t(cells.faceCells[h])] += flux;
  }
  return result;
}

double fastest(const UnsteadyFlow& flow) {
  double speed = 0;
  for (size_t i = 0; i < flow.cellVelocity.size(); i += 3)
    speed = std::max(speed, std::hypot(flow.cellVelocity[i], flow.cellVelocity[i + 1], flow.cellVelocity[i + 2]));
  return speed;
}

/// Steps that have to succeed.
void run(FlowStepper& stepper, int steps) {
  for (int i = 0; i < steps; ++i) {
    const FlowStep step = stepper.step();
    REQUIRE(step.status == SolveStatus::converged);
    REQUIRE(step.divergence <= 1e-10);
  }
}

/// The mean error of the velocity after the time 1.6 of a vortex between four sides.
double vortexError(int64_t n, double viscosity) {
  const double h = kPi / double(n);
  const CellComplex cells = mergedCells(nothing(), Grid::box({0, 0, 0}, {kPi, kPi, h}, {n, n, 1}));
  FlowStepperOptions options;
  options.viscosity = viscosity;
  const int steps = int(1.25 * double(n));
  options.timeStep = 1.6 / steps;
  FlowStepper stepper(cells, {}, options);
  std::vector<double> velocity;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double x = cells.cellCentroid[3 * c], y = cells.cellCentroid[3 * c + 1];
    velocity.insert(velocity.end(), {std::sin(x) * std::cos(y), -std::cos(x) * std::sin(y), 0});
  }
  stepper.start(velocity);
  run(stepper, steps);
  CHECK(stepper.flow().time == Approx(1.6));
  double sum = 0;
  for (size_t i = 0; i < velocity.size(); ++i)
    sum += std::fabs(stepper.flow().cellVelocity[i] - std::exp(-2 * viscosity * 1.6) * velocity[i]);
  return sum / double(cells.cellCount());
}

}  // namespace

TEST_CASE("unsteady: the vortex of Taylor and Green, of second order in space and time", "[unsteady][steps]") {
  for (const double viscosity : {0.0, 0.05}) {
    const std::array<double, 3> errors = {vortexError(16, viscosity), vortexError(32, viscosity), vortexError(64, viscosity)};
    CAPTURE(viscosity, errors);
    CHECK(std::log2(errors[0] / errors[1]) >= 2);
    CHECK(std::log2(errors[1] / errors[2]) >= 2);
  }
}

TEST_CASE("unsteady: a wind that nothing is in the way of stays as it is", "[unsteady]") {
  const Mesh sheet = shapes::quad({1.2, 1.3, 2.5}, {3.7, 1.3, 2.5}, {3.7, 3.6, 2.5}, {1.2, 3.6, 2.5});  // along it
  for (const bool isCoarsened : {false, true}) {
    const CellComplex cells = mergedCells(sheet, Grid::box({0, 0, 0}, {8, 8, 8}, {8, 8, 8}), isCoarsened);
    FlowStepper stepper(cells, {2, -1, 0});
    run(stepper, 5);
    for (size_t i = 0; i < stepper.flow().cellVelocity.size(); ++i)
      REQUIRE(stepper.flow().cellVelocity[i] == Approx(std::array{2.0, -1.0, 0.0}[i % 3]).margin(1e-8));
    CHECK(std::fabs(stepper.forces()[0].pressure[2]) <= 1e-7);
  }
}

TEST_CASE("unsteady: between two plates the flow becomes Poiseuille's", "[unsteady]") {
  // The plates lie between planes of the grid, and end outside of it. H = 1, U = 1, Re = 20.
  Mesh plates = shapes::quad({-1, 0.07, -1}, {9, 0.07, -1}, {9, 0.07, 9}, {-1, 0.07, 9});
  const Mesh upper = shapes::quad({-1, 1.07, -1}, {9, 1.07, -1}, {9, 1.07, 9}, {-1, 1.07, 9});
  plates.positions.insert(plates.positions.end(), upper.positions.begin(), upper.positions.end());
  for (const uint32_t v : upper.triangles) plates.triangles.push_back(v + 4);
  const CellComplex all = mergedCells(plates, Grid::box({0, -0.25, 0}, {4, 1.5, 0.125}, {32, 14, 1}));
  uint32_t region = 0;
  for (size_t c = 0; c < all.cellCount(); ++c) {
    if (std::fabs(all.cellCentroid[3 * c + 1] - 0.57) < 0.1) region = all.cellRegion[c];
  }
  const CellComplex cells = regionComplex(all, region).cells;
  FlowStepperOptions options;
  options.viscosity = 0.05;
  FlowStepper stepper(cells, {1, 0, 0}, options);
  run(stepper, 600);
  double fastestAtEnd = 0, error = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double x = cells.cellCentroid[3 * c], y = cells.cellCentroid[3 * c + 1] - 0.07, u = stepper.flow().cellVelocity[3 * c];
    if (x < 3 || x > 3.8) continue;
    fastestAtEnd = std::max(fastestAtEnd, u);
    error = std::max(error, std::fabs(u - 6 * y * (1 - y)));
  }
  CHECK(fastestAtEnd == Approx(1.5).epsilon(0.02));
  CHECK(error <= 0.03);
  std::vector<uint32_t> late(cells.faceCount());  // 1 for walls with a developed flow
  double area = 0;
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    late[f] = cells.faceCentroid[3 * f] > 3 && cells.faceCentroid[3 * f] < 3.8;
    if (late[f] && cells.faceTag[f] == FaceTag::surface) area += cells.faceArea[f];
  }
  CHECK(stepper.forces(late)[1].viscous[0] == Approx(0.05 * 6 * area).epsilon(0.03));
}

TEST_CASE("unsteady: a sheet across the wind is pushed, each of its sides by what is there", "[unsteady]") {
  const Mesh sheet = shapes::quad({1.1, 1.2, 1.2}, {1.1, 2.8, 1.2}, {1.1, 2.8, 2.8}, {1.1, 1.2, 2.8});
  const CellComplex cells = mergedCells(sheet, Grid::box({0, 0, 0}, {6, 4, 4}, {18, 12, 12}));
  FlowStepperOptions options;
  options.viscosity = 0.01;
  FlowStepper stepper(cells, {1, 0, 0}, options);
  run(stepper, 40);
  const SurfaceForce force = stepper.forces()[0];
  CHECK(force.pressure[0] > 0.5 * 0.5 * 1.6 * 1.6);
  CHECK(std::fabs(force.pressure[1]) <= 1e-6);
  for (const double outflow : outflows(cells, stepper.flow())) REQUIRE(std::fabs(outflow) <= 1e-10);
  // The sides of each triangle apart: both push downwind, by overpressure and by suction.
  double front = 0, back = 0;
  size_t ahead = 0, behind = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double* x = &cells.cellCentroid[3 * c];
    if (std::hypot(x[1] - 2, x[2] - 2) > 0.5) continue;
    if (x[0] > 0.6 && x[0] < 1.1) front += stepper.flow().cellPressure[c], ++ahead;
    if (x[0] > 1.1 && x[0] < 1.6) back += stepper.flow().cellPressure[c], ++behind;
  }
  CHECK(front / double(ahead) > 0.2);
  CHECK(back / double(behind) < 0);
}

TEST_CASE("unsteady: forces by group sum up, and moments move with the centre", "[unsteady]") {
  const Mesh mesh = shapes::icosphere({2.1, 2, 1.9}, 0.9, 2);
  const CutResult result = cut(mesh, Grid::box({0, 0, 0}, {6, 4, 4}, {15, 10, 10}));
  REQUIRE(result);
  CoarsenOptions coarsening;
  coarsening.maxLevel = 0;
  const CellComplex cells = mergeSmallCells(result.mesh, cellComplex(mesh, result.mesh, coarsen(result.mesh, coarsening))).cells;
  FlowStepperOptions options;
  options.viscosity = 0.05;
  FlowStepper stepper(cells, {1, 0.5, 0}, options);
  run(stepper, 10);
  std::vector<uint32_t> triangleGroup(mesh.triangles.size() / 3);
  for (size_t t = 0; t < triangleGroup.size(); ++t) triangleGroup[t] = uint32_t(t % 3);
  const auto groups = stepper.forces(faceGroups(result.mesh, cells, triangleGroup), {1, 2, 3});
  const auto all = stepper.forces({}, {1, 2, 3}), origin = stepper.forces();
  REQUIRE(groups.size() == 3);
  REQUIRE(all.size() == 1);
  for (size_t d = 0; d < 3; ++d) {
    const size_t e = (d + 1) % 3, g = (d + 2) % 3;
    const auto sum = [&](auto member) { return (groups[0].*member)[d] + (groups[1].*member)[d] + (groups[2].*member)[d]; };
    CHECK(sum(&SurfaceForce::pressure) == Approx(all[0].pressure[d]).margin(1e-12));
    CHECK(sum(&SurfaceForce::viscous) == Approx(all[0].viscous[d]).margin(1e-12));
    CHECK(sum(&SurfaceForce::moment) == Approx(all[0].moment[d]).margin(1e-12));
    const auto force = [&](size_t i) { return all[0].pressure[i] + all[0].viscous[i]; };
    const std::array<double, 3> arm = {1, 2, 3};
    CHECK(origin[0].moment[d] == Approx(all[0].moment[d] + arm[e] * force(g) - arm[g] * force(e)).margin(1e-12));
  }
  CHECK(groups[0].pressure[0] != Approx(groups[1].pressure[0]));
  CHECK(all[0].pressure[0] > 0);
  CHECK(all[0].viscous[0] > 0);
  triangleGroup.pop_back();
  CHECK(refusal([&] { faceGroups(result.mesh, cells, triangleGroup); }).first == Status::badArgument);
}

TEST_CASE("unsteady: many steps about all sorts of meshes stay bounded and free of divergence", "[unsteady][steps]") {
  const Mesh sheets = shapes::quad({0.9, 0.8, 0.7}, {2.3, 1.1, 0.9}, {2.1, 2.2, 2.4}, {0.8, 2.1, 2.2});
  const Mesh meshes[] = {shapes::icosphere({1.5, 1.5, 1.5}, 0.7, 2), shapes::torus({1.5, 1.5, 1.5}, 0.7, 0.3, 24, 12), sheets,
                         shapes::noisySphere({1.5, 1.5, 1.5}, 0.8, 0.3, 2), shapes::cube(0.9, 2.1)};
  for (const Mesh& mesh : meshes) {
    const CellComplex cells = mergedCells(mesh, Grid::box({0, 0, 0}, {3, 3, 3}, {10, 10, 10}));
    for (const double viscosity : {0.0, 0.002}) {
      CAPTURE(&mesh - meshes, viscosity);
      FlowStepperOptions options;
      options.viscosity = viscosity;
      FlowStepper stepper(cells, {1, 0.3, -0.2}, options);
      run(stepper, 120);
      CHECK(fastest(stepper.flow()) <= 4);
    }
  }
}

TEST_CASE("unsteady: real meshes, grid cells and octree cells", "[unsteady]") {
  const auto folder = meshFolder();
  if (!folder) return;
  for (const char* name : {"igltut_bunny", "codim_skirt8K", "assimp_Wuson", "trimesh_angle_block", "manifold_self_intersectA"}) {
    const Mesh mesh = readMesh((*folder / (std::string(name) + ".obj.gz")).string());
    for (const bool isCoarsened : {false, true}) {
      CAPTURE(name, isCoarsened);
      const Grid grid = Grid::around(mesh, 16, 0.3);
      const CellComplex cells = mergedCells(mesh, grid, isCoarsened);
      FlowStepperOptions options;
      options.viscosity = 0.001 * (grid.planes[0].back() - grid.planes[0].front());
      FlowStepper stepper(cells, {1, 0, 0}, options);
      run(stepper, 25);
      CHECK(fastest(stepper.flow()) <= 5);
    }
  }
}

TEST_CASE("unsteady: closed rooms are at rest, and others as fast as they can be", "[unsteady]") {
  // A ball with air inside, in a channel that a wall closes at its end.
  Mesh mesh = shapes::icosphere({2, 2, 2}, 1.1, 2);
  const CellComplex cells = mergedCells(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {10, 10, 10}));
  FlowStepper stepper(cells, {1, 0, 0});
  run(stepper, 5);
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    if (cells.cellRegion[c] == cells.cellRegion.back()) continue;
    for (size_t d = 0; d < 3; ++d) REQUIRE(stepper.flow().cellVelocity[3 * c + d] == 0);
  }
  const Mesh wall = shapes::quad({1.7, -1, -1}, {1.7, 5, -1}, {1.7, 5, 5}, {1.7, -1, 5});
  const CellComplex closed = mergedCells(wall, Grid::box({0, 0, 0}, {4, 4, 4}, {6, 6, 6}));
  FlowStepper still(closed, {1, 0, 0});
  CHECK(fastest(still.flow()) == 0);
  CHECK(still.step().status == SolveStatus::breakdown);  // of no length
  CHECK(still.flow().time == 0);
}

TEST_CASE("unsteady: steps that are far too long are taken or refused, and the flow is finite", "[unsteady]") {
  const CellComplex cells = mergedCells(shapes::torus({2, 2, 2}, 1, 0.4, 24, 12), Grid::box({0, 0, 0}, {4, 4, 4}, {8, 8, 8}));
  for (const double viscosity : {0.0, 1e-3}) {
    FlowStepperOptions options;
    options.viscosity = viscosity;
    options.timeStep = 1e4;
    FlowStepper stepper(cells, {1, 0, 0}, options);
    FlowStep step;
    for (int i = 0; i < 100 && step.status == SolveStatus::converged; ++i) step = stepper.step();
    CHECK((step.status == SolveStatus::converged || step.status == SolveStatus::breakdown));
    CHECK(std::isfinite(fastest(stepper.flow())));
  }
}

TEST_CASE("unsteady: the same bits on any number of threads", "[unsteady]") {
  const CellComplex cells = mergedCells(shapes::torus({2, 2, 2}, 1, 0.4, 24, 12), Grid::box({0, 0, 0}, {4, 4, 4}, {12, 12, 12}));
  std::vector<double> velocity;
  for (const unsigned threads : {1u, 3u}) {
    FlowStepperOptions options;
    options.viscosity = 0.01;
    options.threads = threads;
    FlowStepper stepper(cells, {1, 0, 0}, options);
    run(stepper, 3);
    FlowStepper moved = std::move(stepper);
    run(moved, 2);
    if (threads == 1) velocity = moved.flow().cellVelocity;
    CHECK(moved.flow().cellVelocity == velocity);
  }
}

TEST_CASE("unsteady: wrong calls are refused by name", "[unsteady]") {
  const CellComplex cells = mergedCells(shapes::cube(1.2, 2.7), Grid::box({0, 0, 0}, {4, 4, 4}, {4, 4, 4}));
  const auto refused = [&](const auto& change, std::array<double, 3> wind = {1, 0, 0}) {
    FlowStepperOptions options;
    change(options);
    return refusal([&] { FlowStepper(cells, wind, options); }).first;
  };
  CHECK(refused([](FlowStepperOptions&) {}) == Status::ok);
  CHECK(refused([](FlowStepperOptions&) {}, {NAN, 0, 0}) == Status::badArgument);
  CHECK(refused([](FlowStepperOptions& o) { o.viscosity = -1; }) == Status::badOption);
  CHECK(refused([](FlowStepperOptions& o) { o.timeStep = INFINITY; }) == Status::badOption);
  CHECK(refused([](FlowStepperOptions& o) { o.courant = 0; }) == Status::badOption);
  CHECK(refused([](FlowStepperOptions& o) { o.tolerance = 0; }) == Status::badOption);
  CHECK(refused([](FlowStepperOptions& o) { o.maxIterations = -1; }) == Status::badOption);
  CHECK(refused([](FlowStepperOptions& o) { o.corrections = -1; }) == Status::badOption);
  FlowStepper stepper(cells, {1, 0, 0});
  std::vector<double> velocity(3 * cells.cellCount());
  velocity[7] = NAN;
  CHECK(refusal([&] { stepper.start(velocity); }) == std::pair(Status::badArgument, int64_t(2)));
  velocity.pop_back();
  CHECK(refusal([&] { stepper.start(velocity); }) == std::pair(Status::badArgument, int64_t(-1)));
  CHECK(refusal([&] { stepper.forces(std::vector<uint32_t>{1}); }).first == Status::badArgument);
}
