#include "cli/orders/cylinder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mandoline/mandoline.h"
#include "mandoline/unsteady.h"

namespace mandoline::orders {
namespace {

/// A prism of the circle's area, diameter 1, without ends. Off the middle, so that no symmetry delays the vortices.
Mesh cylinder(int64_t perDiameter) {
  const size_t corners = size_t(8 * perDiameter);
  const double angle = 2 * std::numbers::pi / double(corners), radius = 0.5 / std::sqrt(std::sin(angle) / angle),
               h = 1 / double(perDiameter);
  Mesh mesh;
  for (const double z : {-h, 2 * h}) {
    for (size_t i = 0; i < corners; ++i) {
      const double a = angle * (double(i) + 0.5);
      mesh.positions.insert(mesh.positions.end(), {radius * std::cos(a) + 0.003, radius * std::sin(a) + 0.007, z});
    }
  }
  const uint32_t n = uint32_t(corners);
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(), {i, j, n + j, i, n + j, n + i});
  }
  return mesh;
}

/// Planes from `low` to `high`: h apart from `first` to `last`, and more and more beyond.
std::vector<double> stretched(double low, double first, double last, double high, double h) {
  constexpr double kGrowth = 1.1, kWidest = 0.6;
  std::vector<double> planes;
  double x = first;
  for (double step = h; x > low; x -= step) step = std::min(step * kGrowth, kWidest), planes.push_back(x - step);
  std::reverse(planes.begin(), planes.end());
  const int64_t count = std::llround((last - first) / h);
  for (int64_t i = 0; i <= count; ++i) planes.push_back(first + double(i) * h);
  x = planes.back();
  for (double step = h; x < high; x += step) step = std::min(step * kGrowth, kWidest), planes.push_back(x + step);
  return planes;
}

CellComplex cellsAbout(int64_t perDiameter) {
  const double h = 1 / double(perDiameter);
  const Mesh mesh = cylinder(perDiameter);
  const CutResult result = cut(mesh, Grid::rectilinear({stretched(-8, -0.75, 1.5, 16, h), stretched(-9, -0.75, 0.75, 9, h), {0, h}}));
  if (!result) throw std::runtime_error(result.error.message);
  CoarsenOptions options;
  options.maxLevel = 0;
  const CellComplex merged = mergeSmallCells(result.mesh, cellComplex(mesh, result.mesh, coarsen(result.mesh, options))).cells;
  return regionComplex(uniteWalls(result.mesh, merged), merged.cellRegion.back()).cells;
}

}  // namespace

Shedding sheddingOf(int64_t perDiameter) {
  constexpr double kEnd = 45;
  constexpr int kPeriods = 3;  // the last ones
  const CellComplex cells = cellsAbout(perDiameter);
  FlowStepperOptions options;
  options.viscosity = 0.01;
  FlowStepper stepper(cells, {1, 0, 0}, options);
  std::vector<double> velocity;  // with a gust behind the cylinder, which makes the wake swing at once
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double x = cells.cellCentroid[3 * c] - 1.2, y = cells.cellCentroid[3 * c + 1];
    velocity.insert(velocity.end(), {1, 0.5 * std::exp(-2 * (x * x + y * y)), 0});
  }
  stepper.start(velocity);
  Shedding result;
  result.cells = cells.cellCount();
  struct Period {
    double begin, drag, lift;
  };
  std::vector<Period> periods{{0, 0, 0}};
  for (double last = 0; stepper.flow().time < kEnd; ++result.steps) {
    const FlowStep step = stepper.step();
    if (step.status != SolveStatus::converged) throw std::runtime_error(std::string("a step of the flow: ") + name(step.status));
    result.divergence = std::max(result.divergence, step.divergence);
    const SurfaceForce force = stepper.forces()[0];
    const double scale = 2 * double(perDiameter), lift = scale * (force.pressure[1] + force.viscous[1]);
    if (last < 0 && lift >= 0) periods.push_back({stepper.flow().time, 0, 0});
    last = lift;
    periods.back().drag += scale * (force.pressure[0] + force.viscous[0]) * step.timeStep;
    periods.back().lift = std::max(periods.back().lift, std::fabs(lift));
  }
  if (periods.size() < kPeriods + 2) throw std::runtime_error("the cylinder sheds no vortices");
  const auto end = periods.end() - 1, begin = end - kPeriods;
  for (auto p = begin; p < end; ++p) result.drag += p->drag, result.lift = std::max(result.lift, p->lift);
  result.drag /= end->begin - begin->begin;
  result.strouhal = kPeriods / (end->begin - begin->begin);
  return result;
}

}  // namespace mandoline::orders
