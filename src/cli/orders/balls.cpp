#include "cli/orders/balls.h"

#include <cstdio>
#include <map>

#include "cli/orders/discretisations.h"
#include "cli/orders/exact.h"
#include "mandoline/shapes.h"

namespace mandoline::orders {
namespace {

/// What is measured, per N: phi in the mean and at worst, derivatives on faces, and on the surface unless they are given there.
constexpr size_t kMeasured = 6;
constexpr const char* kMeasuredNames[kMeasured] = {"phi, mean",      "phi, largest",  "faces, mean",
                                                   "faces, largest", "surface, mean", "surface, largest"};
using Numbers = std::array<double, kMeasured>;
using LeastOrders = std::array<Numbers, kWays>;  // a little below what they are

struct Ball {
  const char* title;
  const Exact& exact;
  Point centre;
  double radius, box;  ///< the grid is [-box, box]^3
  bool isInside;
  DualPoints points;
  LeastOrders leastOrders;
};

/// The least orders of the largest errors over two halvings.
double leastOverHalvings(const Ball& ball, size_t measured) {
  if (measured == 1) return ball.exact.surface == Condition::neumann ? 1.5 : 1.7;
  return measured == 3 ? 1.3 : measured == 5 ? 1 : 0;
}

CellComplex cellsOf(const Ball& ball, const Mesh& mesh, const Discretisation& way, int64_t n) {
  const double b = ball.box;
  const CellComplex all = allCells(mesh, Grid::box({-b, -b, -b}, {b, b, b}, {n, n, n}), way);
  return ball.isInside ? inside(all) : outside(all);
}

struct Made {
  size_t cells;
  Numbers errors;
};

/// Others are about as near on faces as grid cells at each N: at some N merged cells lie beside larger ones. `isFew`: whether most octree
/// cells are large at N = 128; they have to be nearly as near, too.
void compare(const std::string& row, bool isFew, const Made& made, const std::pair<int64_t, Made>& ofGrid, Orders& orders) {
  const auto& [n, grid] = ofGrid;
  const std::string at = ", N = " + std::to_string(n) + ", over that of grid cells";
  orders.require(row + ", " + kMeasuredNames[3] + at, made.errors[3] / grid.errors[3], 0, 2.5);
  if (n != 128 || !isFew) return;
  for (size_t i = 0; i < 4; ++i) orders.require(row + ", " + kMeasuredNames[i] + at, made.errors[i] / grid.errors[i], 0, 1.5);
  orders.require(row + ", unknowns" + at, double(made.cells) / double(grid.cells), 0, 0.05);
}

using MadeOfGrids = std::map<int64_t, Made>;  // per N

void printErrors(const Ball& ball, size_t way, const std::vector<int64_t>& cells, Orders& orders, MadeOfGrids& ofGrids) {
  const Discretisation& d = kDiscretisations[way];
  const Mesh mesh = makeSphere(ball.centre, ball.radius, 7);
  Numbers before{}, at16{};
  int64_t nBefore = 0;
  for (const int64_t n : cells) {
    const CellComplex mine = cellsOf(ball, mesh, d, n);
    SolveOptions options;
    options.balance = true;  // midpoints don't integrate the derivative on the sides exactly
    const PoissonProblem problem = problemOf(mine, ball.exact, ball.points);
    const Solution solution = solvePoisson(mine, problem, options);
    const Errors phi = errorsOf(mine, ball.exact, ball.points, solution.phi), faces = faceErrorsOf(mine, ball.exact, solution),
                 surface = surfaceErrorsOf(mine, ball.exact, problem.boundary, solution);
    const Numbers errors{phi.mean, phi.largest, faces.mean, faces.largest, surface.mean, surface.largest};
    std::printf("| %s | %s | %lld | %zu | %zu |", ball.title, d.name, (long long)n, mine.cellCount(), solution.iterations());
    for (size_t i = 0; i < kMeasured; ++i) {
      if (i >= 4 && ball.exact.surface == Condition::neumann) {
        std::printf(" | |");
        continue;
      }
      std::printf(" %.1e |", errors[i]);
      const std::string row = std::string(ball.title) + ", " + d.name + ", " + kMeasuredNames[i];
      if (nBefore)
        std::printf(" %.1f |", orders.of(row, {nBefore, n}, {before[i], errors[i]}, ball.leastOrders[way][i]));
      else
        std::printf(" |");
      if (n == 64 && at16[i] > 0) orders.ofHalvings(row, {at16[i], errors[i]}, leastOverHalvings(ball, i));
    }
    std::printf("\n");
    const Made made{mine.cellCount(), errors};
    const auto ofGrid = ofGrids.try_emplace(n, made).first;  // grid cells come first
    compare(std::string(ball.title) + ", " + d.name, d.isCoarsened && ball.exact.surfaceStops, made, *ofGrid, orders);
    before = errors, nBefore = n;
    if (n == 16) at16 = errors;
  }
}

/// A ball that lies off the middle of the grid.
Ball offCentre(const char* title, const Exact& exact, bool isInside, DualPoints points, const LeastOrders& leastOrders) {
  return {title, exact, {0.1, 0.05, -0.02}, 0.6, 1, isInside, points, leastOrders};
}

}  // namespace

void printBalls(const std::vector<int64_t>& cells, Orders& orders) {
  std::printf("| a ball | cells | N | unknowns | iterations |");
  for (const char* measured : kMeasuredNames) std::printf(" %s | order |", measured);
  std::printf("\n|---|---|---|---|---|");
  for (size_t i = 0; i < 2 * kMeasured; ++i) std::printf("---|");
  std::printf("\n");
  const Ball balls[] = {{"flow about it",
                         kSphereFlow,
                         {0, 0, 0},
                         1,
                         2,
                         false,
                         DualPoints::centres,
                         {{{1.9, 2.3, 1.8, 1.3}, {1.8, 2.3, 1.8, 1.3}, {1.9, 1.8, 1.8, 1.6}, {1.8, 1.9, 1.8, 1.5}}}},
                        offCentre("derivative given on it", kManufactured, false, DualPoints::centres,
                                  {{{2.4, 2.4, 1.9, 1.7}, {1.8, 2.1, 2.1, 1.8}, {2.4, 2.2, 2.0, 1.8}, {1.8, 1.1, 2.2, 1.8}}}),
                        offCentre("value given on it", kHeld, false, DualPoints::centroids,
                                  {{{2.4, 2.5, 1.9, 1.4, 2.1, 1.8},
                                    {1.9, 0.6, 2.1, 1.5, 2.1, 1.9},
                                    {2.4, 2.5, 2.0, 1.8, 2.1, 1.9},
                                    {1.9, 1.2, 2.1, 1.4, 2.1, 1.9}}}),
                        offCentre("value given on it, inside", kHeld, true, DualPoints::centroids,
                                  {{{2.6, 2.6, 2.1, 1.9, 1.7, 1.5},
                                    {2.8, 2.0, 2.2, 1.9, 1.7, 1.5},
                                    {2.6, 2.6, 2.2, 1.6, 1.9, 1.2},
                                    {2.8, 2.3, 2.3, 1.6, 1.9, 1.2}}}),
                        offCentre("Robin condition on it", kRobin, false, DualPoints::centroids,
                                  {{{2.4, 2.2, 2.0, 1.9, 2.7, 2.7},
                                    {1.8, 1.0, 2.1, 1.8, 2.2, 2.8},
                                    {2.4, 1.9, 2.0, 1.7, 2.7, 2.5},
                                    {1.8, 1.2, 2.2, 1.7, 2.5, 2.6}}}),
                        offCentre("Robin condition on it, inside", kRobin, true, DualPoints::centroids,
                                  {{{2.0, 2.1, 2.2, 1.2, 2.4, 2.7},
                                    {2.7, 2.5, 2.1, 1.2, 2.7, 2.7},
                                    {2.2, 2.1, 2.2, 1.6, 2.5, 2.6},
                                    {2.8, 2.3, 2.2, 1.6, 2.8, 2.5}}})};
  for (const Ball& ball : balls) {
    MadeOfGrids ofGrids;
    for (size_t way = 0; way < kWays; ++way) printErrors(ball, way, cells, orders, ofGrids);
  }
}

}  // namespace mandoline::orders
