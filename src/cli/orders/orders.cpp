// Prints how Poisson's equation on the cells converges, what solving it takes, and how a cylinder sheds vortices.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <stdexcept>

#include "cli/mesh_paths.h"
#include "cli/orders/balls.h"
#include "cli/orders/cylinder.h"
#include "cli/orders/discretisations.h"
#include "cli/orders/speeds.h"
#include "cli/values.h"
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

std::vector<int64_t> numbersOf(const std::string& word) {
  const std::vector<int64_t> numbers = cli::parseList<int64_t>(word);
  if (numbers.empty()) throw std::invalid_argument(word);
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

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }  // of the processor

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
