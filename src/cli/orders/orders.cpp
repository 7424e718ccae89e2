// Prints how Poisson's equation on the cells converges, and what solving it takes.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "cli/mesh_paths.h"
#include "cli/orders/speeds.h"
#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#include "mandoline/shapes.h"

namespace mandoline::orders {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp =
    R"(mandoline-orders [--meshes FOLDER] [--mesh MESH] [--cells N,...]

Solves Poisson's equation on cells and prints as tables of Markdown:
  errors against exact solutions outside of a ball at each N of --cells (default 16,32,64), and the orders that follow
  errors of velocities about a ball, and the largest speed on it
  a linear field on every mesh of FOLDER: its largest error, relative to the field's range
  unknowns, iterations and processor time of the flow about MESH (default: a torus knot), outside of it
Exit code 1 if an order is lower than it has to be from N = 16 to 32 or from 32 to 64.
)";

struct Arguments {
  std::string folder, mesh;
  std::vector<int64_t> cells = {16, 32, 64};
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (i + 1 == words.size()) throw std::invalid_argument(word);
    std::string value = words[++i];
    if (word == "--meshes")
      arguments.folder = value;
    else if (word == "--mesh")
      arguments.mesh = value;
    else if (word == "--cells") {
      arguments.cells.clear();
      for (size_t end = 0; !value.empty(); value.erase(0, end + 1)) {
        arguments.cells.push_back(std::stoll(value, &end));
        if (end == value.size()) break;
      }
    } else
      throw std::invalid_argument(word);
  }
  return arguments;
}

CellComplex allCells(const Mesh& mesh, const Grid& grid, int maxLevel, int fineLayers = 0) {
  const CutResult result = cut(mesh, grid);
  if (!result) throw std::runtime_error(result.error.message);
  CoarsenOptions options;
  options.maxLevel = maxLevel;
  options.fineLayers = fineLayers;
  return cellComplex(mesh, result.mesh, coarsen(result.mesh, options));
}

/// The region of the grid's last untouched cell, which is the outside.
CellComplex outside(const CellComplex& cells) { return regionComplex(cells, cells.cellRegion.back()).cells; }

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }  // of the processor

struct Discretisation {
  const char* name;
  DualPoints points;
  int maxLevel, fineLayers;
};
constexpr Discretisation kDiscretisations[] = {{"single grid cells", DualPoints::centres, 0, 0},
                                               {"the same, centroids", DualPoints::centroids, 0, 0},
                                               {"octree cells of level 0 and 1", DualPoints::centres, 1, 0},
                                               {"the same, one fine layer", DualPoints::centres, 1, 1}};

struct LeastOrders {
  double mean, largest;
};

struct Ball {
  const char* title;
  const Exact& exact;
  Point centre;
  double radius, box;                                    ///< the grid is [-box, box]^3
  LeastOrders leastOrders[std::size(kDiscretisations)];  ///< a little below what they are
};

/// The order that two errors show, and what is said of orders that are too low.
class Orders {
 public:
  /// `row` names what is measured.
  double of(const std::string& row, std::array<int64_t, 2> n, std::array<double, 2> errors, double least) {
    const double order = std::log(errors[0] / errors[1]) / std::log(double(n[1]) / double(n[0]));
    const bool isBounded = n[1] == 2 * n[0] && (n[0] == 16 || n[0] == 32);
    if (isBounded && !(order >= least)) {
      std::ostringstream text;
      text << std::fixed << std::setprecision(2) << row << ", N = " << n[1] << ": order " << order << ", should be at least " << least;
      tooLow_.push_back(text.str());
    }
    return order;
  }
  const std::vector<std::string>& tooLow() const { return tooLow_; }

 private:
  std::vector<std::string> tooLow_;
};

void printErrors(const Ball& ball, size_t discretisation, const std::vector<int64_t>& cells, Orders& orders) {
  const Discretisation& d = kDiscretisations[discretisation];
  const LeastOrders& least = ball.leastOrders[discretisation];
  const std::string row = std::string(ball.title) + ", " + d.name;
  const Mesh mesh = makeSphere(ball.centre, ball.radius, 7);
  Errors before;
  int64_t nBefore = 0;
  for (const int64_t n : cells) {
    const double b = ball.box;
    const CellComplex mine = outside(allCells(mesh, Grid::box({-b, -b, -b}, {b, b, b}, {n, n, n}), d.maxLevel, d.fineLayers));
    SolveOptions options;
    options.balance = true;  // midpoints don't integrate the derivative on the sides exactly
    const Solution solution = solvePoisson(mine, problemOf(mine, ball.exact, d.points), options);
    const Errors errors = errorsOf(mine, ball.exact, d.points, solution.phi);
    std::printf("| %s | %s | %lld | %zu | %zu | %.2e | ", ball.title, d.name, (long long)n, mine.cellCount(), solution.iterations(),
                errors.mean);
    if (nBefore)
      std::printf("%.2f | %.2e | %.2f |\n", orders.of(row + ", mean error", {nBefore, n}, {before.mean, errors.mean}, least.mean),
                  errors.largest, orders.of(row + ", largest error", {nBefore, n}, {before.largest, errors.largest}, least.largest));
    else
      std::printf("| %.2e | |\n", errors.largest);
    before = errors, nBefore = n;
  }
}

void printBalls(const std::vector<int64_t>& cells, Orders& orders) {
  std::printf("| outside of a ball | cells | N | unknowns | iterations | mean error | order | largest error | order |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  constexpr double kNone = -HUGE_VAL;  // with centroids, the largest error has not begun to fall at N = 32
  const Ball balls[] = {{"manufactured", kManufactured, {0.1, 0.05, -0.02}, 0.6, 1, {{1.9, 1.7}, {1.05, 0.7}, {1.9, 0.6}, {1.6, 1.7}}},
                        {"potential flow", kSphereFlow, {0, 0, 0}, 1, 2, {{1.8, 1.6}, {0.8, kNone}, {1.5, 1.1}, {1.0, 1.8}}}};
  for (const Ball& ball : balls) {
    for (size_t d = 0; d < std::size(kDiscretisations); ++d) printErrors(ball, d, cells, orders);
  }
}

void printSpeeds(const std::vector<int64_t>& cells, Orders& orders) {
  std::printf("\n| velocities of the potential flow | N | mean error | order | largest speed on the surface (exact: 1.5) |\n");
  std::printf("|---|---|---|---|---|\n");
  const Mesh mesh = makeSphere({0, 0, 0}, 1, 7);
  for (const auto& [discretisation, least] : {std::pair(0, 1.8), {2, 1.6}, {3, 1.3}}) {
    const Discretisation& d = kDiscretisations[discretisation];
    double before = 0;
    int64_t nBefore = 0;
    for (const int64_t n : cells) {
      const CellComplex mine = outside(allCells(mesh, Grid::box({-2, -2, -2}, {2, 2, 2}, {n, n, n}), d.maxLevel, d.fineLayers));
      const Speeds speeds = speedsOf(mine, kSphereFlow);
      std::printf("| %s | %lld | %.2e | ", d.name, (long long)n, speeds.meanError);
      if (nBefore) std::printf("%.2f ", orders.of(std::string("velocities, ") + d.name, {nBefore, n}, {before, speeds.meanError}, least));
      std::printf("| %.3f |\n", speeds.largestOnSurface);
      before = speeds.meanError, nBefore = n;
    }
  }
}

/// The largest error of a linear field in all regions, relative to its range.
double linearError(const Mesh& mesh, const Grid& grid, int maxLevel) {
  const CellComplex cells = allCells(mesh, grid, maxLevel);
  SolveOptions options;
  options.tolerance = 1e-13;
  const Solution solution = solvePoisson(cells, problemOf(cells, kLinear, DualPoints::centres), options);
  if (solution.status != SolveStatus::converged) return HUGE_VAL;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const double phi = kLinear.phi({cells.cellCentre[3 * c], cells.cellCentre[3 * c + 1], cells.cellCentre[3 * c + 2]});
    low = std::min(low, phi), high = std::max(high, phi);
  }
  return errorsOf(cells, kLinear, DualPoints::centres, solution.phi).largest / (high - low);
}

void printLinear(const std::string& folder, int64_t n) {
  std::printf("\n| a linear field, N = %lld | meshes | error at most 1e-10 | largest error | of |\n|---|---|---|---|---|\n", (long long)n);
  for (const int maxLevel : {0, 24}) {
    size_t meshes = 0, exact = 0;
    double largest = 0;
    std::string worst;
    for (const fs::path& path : cli::meshesIn(folder)) {
      try {
        const Mesh mesh = readMesh(path.string());
        const double error = linearError(mesh, Grid::around(mesh, n), maxLevel);
        ++meshes, exact += error <= 1e-10;
        if (error > 1e-10) std::cerr << path.filename().string() << ": " << error << '\n';
        if (error >= largest) largest = error, worst = path.filename().string();
      } catch (const std::runtime_error& error) {
        std::cerr << "left out: " << path.filename().string() << ": " << error.what() << '\n';
      }
    }
    std::printf("| %s | %zu | %zu | %.1e | %s |\n", maxLevel ? "octree cells" : "single grid cells", meshes, exact, largest, worst.c_str());
  }
}

void printSolver(const std::string& path, const std::vector<int64_t>& cells) {
  const Mesh mesh = path.empty() ? makeTorusKnot() : readMesh(path);
  const std::string name = path.empty() ? "a torus knot" : fs::path(path).filename().string();
  std::printf("\n| flow about %s | N | unknowns | iterations | s |\n|---|---|---|---|---|\n", name.c_str());
  for (const int maxLevel : {0, 24}) {
    for (const int64_t n : cells) {
      const CellComplex mine = outside(allCells(mesh, Grid::around(mesh, n), maxLevel));
      PoissonProblem problem = problemOf(mine, kLinear, DualPoints::centres);
      setBoundary(problem.boundary, mine, FaceTag::surface, Condition::neumann);
      const double begin = seconds();
      const Solution solution = solvePoisson(mine, problem);
      std::printf("| %s | %lld | %zu | %zu | %.2f |\n", maxLevel ? "octree cells" : "single grid cells", (long long)n, mine.cellCount(),
                  solution.iterations(), seconds() - begin);
    }
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
    for (const std::string& row : orders.tooLow()) std::cerr << row << "\n";
    return orders.tooLow().empty() ? 0 : 1;
  } catch (const std::logic_error&) {
    std::cerr << kHelp;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "mandoline-orders: " << error.what() << "\n";
    return 1;
  }
}
