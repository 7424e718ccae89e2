// Prints how Poisson's equation on the cells converges, what solving it takes, and how a cylinder sheds vortices.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "cli/mesh_paths.h"
#include "cli/orders/cylinder.h"
#include "cli/orders/speeds.h"
#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#include "mandoline/shapes.h"

namespace mandoline::orders {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp =
    R"(mandoline-orders [--meshes FOLDER] [--mesh MESH] [--cells N,...] [--cylinder N,...]

Solves Poisson's equation on cells and prints as tables of Markdown:
  errors against exact solutions about a ball and in it at each N of --cells (default 16,32,64), and the orders that
  follow: of phi at dual points, and of its derivatives on faces between cells and on the surface
  errors of velocities about a ball, and the largest speed on it
  a linear field on every mesh of FOLDER: its largest error, relative to the field's range
  unknowns, iterations and processor time of the flow about MESH (default: a torus knot), outside of it
  Strouhal number, drag and lift of a cylinder with each N of --cylinder cells to its diameter (default 8), at Re = 100
Exit code 1 if an order is lower than it has to be from N = 16 to 32, from 32 to 64 or from 16 to 64, if derivatives are far worse than
those of grid cells, if at N = 128 octree cells err more than half as much again or are too many, or if the cylinder's numbers are not
those known.
)";

struct Arguments {
  std::string folder, mesh;
  std::vector<int64_t> cells = {16, 32, 64}, cylinder = {8};
};

std::vector<int64_t> numbersOf(std::string list) {
  std::vector<int64_t> numbers;
  for (size_t end = 0; !list.empty(); list.erase(0, end + 1)) {
    numbers.push_back(std::stoll(list, &end));
    if (end == list.size()) break;
  }
  return numbers;
}

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (i + 1 == words.size()) throw std::invalid_argument(word);
    const std::string& value = words[++i];
    if (word == "--meshes")
      arguments.folder = value;
    else if (word == "--mesh")
      arguments.mesh = value;
    else if (word == "--cells")
      arguments.cells = numbersOf(value);
    else if (word == "--cylinder")
      arguments.cylinder = numbersOf(value);
    else
      throw std::invalid_argument(word);
  }
  return arguments;
}

/// How the cells are made: as by the library's defaults, but for what is said.
struct Discretisation {
  const char* name;
  bool isCoarsened, isMerged;
};
constexpr Discretisation kDiscretisations[] = {
    {"grid cells", false, false}, {"octree cells", true, false}, {"merged", false, true}, {"octree cells, merged", true, true}};
constexpr size_t kWays = std::size(kDiscretisations);

CellComplex allCells(const Mesh& mesh, const Grid& grid, const Discretisation& way) {
  const CutResult result = cut(mesh, grid);
  if (!result) throw std::runtime_error(result.error.message);
  CoarsenOptions options;
  if (!way.isCoarsened) options.maxLevel = 0;
  CellComplex cells = cellComplex(mesh, result.mesh, coarsen(result.mesh, options));
  return way.isMerged ? mergeSmallCells(result.mesh, cells).cells : cells;
}

/// The region of the grid's last untouched cell, which is the outside.
CellComplex outside(const CellComplex& cells) { return regionComplex(cells, cells.cellRegion.back()).cells; }
/// The region of the first cut-cell that is not of the outside.
CellComplex inside(const CellComplex& cells) {
  const auto found =
      std::find_if(cells.cellRegion.begin(), cells.cellRegion.end(), [&](uint32_t r) { return r != cells.cellRegion.back(); });
  return regionComplex(cells, *found).cells;
}

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }  // of the processor

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

/// The order that two errors show, and what is said of numbers that are not as they should be.
class Orders {
 public:
  /// `row` names what is measured.
  double of(const std::string& row, std::array<int64_t, 2> n, std::array<double, 2> errors, double least) {
    const double order = std::log(errors[0] / errors[1]) / std::log(double(n[1]) / double(n[0]));
    const bool isBounded = n[1] == 2 * n[0] && (n[0] == 16 || n[0] == 32);
    if (isBounded && !(order >= least)) {
      std::ostringstream text;
      text << std::fixed << std::setprecision(2) << row << ", N = " << n[1] << ": order " << order << ", should be at least " << least;
      complaints_.push_back(text.str());
    }
    return order;
  }
  /// The same of what two halvings show. One halving may leave the largest octree cells as large as they were: from 16 to 32 it does.
  void ofHalvings(const std::string& row, std::array<double, 2> errors, double least) {
    const double order = std::log(errors[0] / errors[1]) / std::log(4);
    require("the order from N = 16 to 64 of " + row, order, least, HUGE_VAL);
  }
  void require(const std::string& row, double value, double least, double most) {
    if (value >= least && value <= most) return;
    std::ostringstream text;
    text << row << " is " << value << ", should be " << least << " to " << most;
    complaints_.push_back(text.str());
  }
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  std::vector<std::string> complaints_;
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
  orders.require(row + ", " + kMeasuredNames[3] + at, made.errors[3] / grid.errors[3], 0, 2);
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

void printSpeeds(const std::vector<int64_t>& cells, Orders& orders) {
  std::printf("\n| velocities of the potential flow | N | mean error | order | largest speed on the surface (exact: 1.5) |\n");
  std::printf("|---|---|---|---|---|\n");
  const Mesh mesh = makeSphere({0, 0, 0}, 1, 7);
  constexpr double kLeast[kWays] = {1.9, 1.9, 1.9, 1.9};
  for (size_t way = 0; way < kWays; ++way) {
    const Discretisation& d = kDiscretisations[way];
    double before = 0;
    int64_t nBefore = 0;
    for (const int64_t n : cells) {
      const CellComplex mine = outside(allCells(mesh, Grid::box({-2, -2, -2}, {2, 2, 2}, {n, n, n}), d));
      const Speeds speeds = speedsOf(mine, kSphereFlow);
      std::printf("| %s | %lld | %.2e | ", d.name, (long long)n, speeds.meanError);
      if (nBefore)
        std::printf("%.2f ", orders.of(std::string("velocities, ") + d.name, {nBefore, n}, {before, speeds.meanError}, kLeast[way]));
      std::printf("| %.3f |\n", speeds.largestOnSurface);
      before = speeds.meanError, nBefore = n;
    }
  }
}

/// The largest error of a linear field in all regions, relative to its range.
double linearError(const Mesh& mesh, const Grid& grid, const Discretisation& way) {
  const CellComplex cells = allCells(mesh, grid, way);
  SolveOptions options;
  options.tolerance = 1e-13;
  const Solution solution = solvePoisson(cells, problemOf(cells, kLinear, DualPoints::centres), options);
  if (!isSolved(solution.status)) return HUGE_VAL;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double phi = kLinear.phi({cells.cellCentre[3 * c], cells.cellCentre[3 * c + 1], cells.cellCentre[3 * c + 2]});
    low = std::min(low, phi), high = std::max(high, phi);
  }
  return errorsOf(cells, kLinear, DualPoints::centres, solution.phi).largest / (high - low);
}

void printLinear(const std::string& folder, int64_t n) {
  std::printf("\n| a linear field, N = %lld | meshes | error at most 1e-10 | largest error | of |\n|---|---|---|---|---|\n", (long long)n);
  for (const Discretisation& way : {kDiscretisations[0], kDiscretisations[1]}) {
    size_t meshes = 0, exact = 0;
    double largest = 0;
    std::string worst;
    for (const fs::path& path : cli::meshesIn(folder)) {
      try {
        const Mesh mesh = readMesh(path.string());
        const double error = linearError(mesh, Grid::around(mesh, n), way);
        ++meshes, exact += error <= 1e-10;
        if (error > 1e-10) std::cerr << path.filename().string() << ": " << error << '\n';
        if (error >= largest) largest = error, worst = path.filename().string();
      } catch (const std::runtime_error& error) {
        std::cerr << "left out: " << path.filename().string() << ": " << error.what() << '\n';
      }
    }
    std::printf("| %s | %zu | %zu | %.1e | %s |\n", way.name, meshes, exact, largest, worst.c_str());
  }
}

void printSolver(const std::string& path, const std::vector<int64_t>& cells) {
  const Mesh mesh = path.empty() ? makeTorusKnot() : readMesh(path);
  const std::string name = path.empty() ? "a torus knot" : fs::path(path).filename().string();
  std::printf("\n| flow about %s | N | unknowns | iterations | s |\n|---|---|---|---|---|\n", name.c_str());
  for (const Discretisation& way : kDiscretisations) {
    for (const int64_t n : cells) {
      const CellComplex mine = outside(allCells(mesh, Grid::around(mesh, n), way));
      PoissonProblem problem = problemOf(mine, kLinear, DualPoints::centres);
      setBoundary(problem.boundary, mine, FaceTag::surface, Condition::neumann);
      const double begin = seconds();
      const Solution solution = solvePoisson(mine, problem);
      std::printf("| %s | %lld | %zu | %zu | %.2f |\n", way.name, (long long)n, mine.cellCount(), solution.iterations(), seconds() - begin);
    }
  }
}

void printCylinder(const std::vector<int64_t>& perDiameter, Orders& orders) {
  std::printf("\n| a cylinder at Re = 100 | cells | steps | Strouhal number | drag | lift | divergence | ms a step |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const int64_t n : perDiameter) {
    const double begin = seconds();
    const Shedding found = sheddingOf(n);
    std::printf("| %lld to a diameter | %zu | %zu | %.4f | %.3f | %.3f | %.1e | %.1f |\n", (long long)n, found.cells, found.steps,
                found.strouhal, found.drag, found.lift, found.divergence, 1e3 * (seconds() - begin) / double(found.steps));
    orders.require("the cylinder's Strouhal number", found.strouhal, 0.155, 0.175);
    orders.require("the cylinder's drag", found.drag, 1.25, 1.45);
    orders.require("divergence about the cylinder", found.divergence, 0, 1e-10);
  }
}

}  // namespace
}  // namespace mandoline::orders

int main(int argc, char** argv) {
  using namespace mandoline::orders;
  try {
    const Arguments arguments = parse({argv + 1, argv + argc});
    Orders orders;
    printBalls(arguments.cells, orders);
    printSpeeds(arguments.cells, orders);
    if (!arguments.folder.empty()) printLinear(arguments.folder, arguments.cells.front());
    printSolver(arguments.mesh, arguments.cells);
    printCylinder(arguments.cylinder, orders);
    for (const std::string& complaint : orders.complaints()) std::cerr << complaint << "\n";
    return orders.complaints().empty() ? 0 : 1;
  } catch (const std::logic_error&) {
    std::cerr << kHelp;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "mandoline-orders: " << error.what() << "\n";
    return 1;
  }
}
