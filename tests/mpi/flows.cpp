// Compares flows by several processes with those of one. Run by MPI in any number of processes:
//
//   mandoline-mpi-flows CELLS EVERY
//
// as mandoline-mpi-pieces, of cells as they are and merged, of octree cells, with walls united, and in the far field. Both solve the same
// system; they differ by what their solvers leave of the residual. Corrections, and passes of the far field, end where little is missing,
// and what is then missing depends on how well systems are solved before: so these are compared with those of one process that solves as
// well, and less strictly with solveFlow().
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "cli/mpi/flow/rank_flow.h"
#include "mandoline/io.h"
#include "mandoline/merge.h"
#include "mpi/merged_ranks.h"
#include "real_meshes.h"
#include "shapes.h"

using namespace mandoline;

namespace {

constexpr double kMostOff = 1e-9;     // of phi, of the largest
constexpr double kMostSpilt = 1e-12;  // of what flows into a cell, of the largest flow through a face

constexpr double kMostMissing = 1e-4;  // as kMostOff, of solutions that are corrected until so little is missing
constexpr double kMostFar = 1e-3;      // likewise in the far field, where passes end when so little of the wind is missing on the sides

struct Kind {
  double fraction;  // of cells that are merged
  int corrections;
  int levels = 0;    // of octree cells
  double walls = 0;  // the angle at which they unite, or 0
  bool farField = false;

  cli::RankFlowOptions options() const { return {corrections, farField, nullptr}; }

  CoarsenOptions coarsening() const {
    CoarsenOptions options;
    options.maxLevel = levels;
    return options;
  }
};

struct Found {
  double off = 0, speedOff = 0, missing = 0;
  uint64_t corrections = 0;  // of all processes
  cli::RankFlow flow;
};

/// Own cells and their faces are those of the whole.
void requireCells(const RankComplex& mine, int rank, const CellComplex& cells) {
  if (mine.wholeCells != cells.cellCount() || mine.wholeCutCells != cells.cutCells) throw std::runtime_error("other cells in all");
  const auto require = [](bool isSo, const char* what) {
    if (!isSo) throw std::runtime_error(std::string("another ") + what);
  };
  for (size_t c = 0; c < mine.cells.cellCount(); ++c) {
    if (mine.cellRanks[c] != rank) continue;
    const size_t id = mine.cellIds[c];
    require(mine.cells.cellVolume[c] == cells.cellVolume[id] && mine.cells.cellRegion[c] == cells.cellRegion[id], "cell");
    for (size_t d = 0; d < 3; ++d) {
      require(mine.cells.cellCentroid[3 * c + d] == cells.cellCentroid[3 * id + d], "centroid");
      require(mine.cells.cellCorner[3 * c + d] == cells.cellCorner[3 * id + d], "base");
    }
    const auto here = mine.cells.halfFaces(c), whole = cells.halfFaces(id);
    require(here.size() == whole.size(), "number of faces");
    for (size_t i = 0; i < here.size(); ++i) {
      const int32_t across = mine.cells.faceCells[here[i] ^ 1], other = cells.faceCells[whole[i] ^ 1];
      require(mine.cells.faceArea[here[i] / 2] == cells.faceArea[whole[i] / 2], "area");
      require(across < 0 ? other < 0 : other >= 0 && mine.cellIds[size_t(across)] == uint64_t(other), "neighbour");
    }
  }
}

RankComplex complexFor(detail::Communicator& comm, const DistributedCut& cut, const Kind& kind) {
  const WallOptions walls{{1, {}}, kind.walls, {}};
  return detail::mergedComplex(comm, cut, cut.piece(),
                               {kind.fraction, kind.coarsening(), cli::kFlowGhosts, kind.walls > 0 ? &walls : nullptr});
}

CellComplex wholeComplex(const Mesh& mesh, const CutMesh& cutMesh, const Kind& kind) {
  MergeOptions merging;
  merging.fraction = kind.fraction;
  CellComplex cells = mergeSmallCells(cutMesh, cellComplex(mesh, cutMesh, coarsen(cutMesh, kind.coarsening())), merging).cells;
  return kind.walls > 0 ? uniteWalls(cutMesh, cells, {{1, {}}, kind.walls, {}}) : std::move(cells);
}

/// That of one process, per cell of the whole.
Flow flowOfOne(const PreparedMesh& prepared, const Grid& grid, const std::array<double, 3>& wind, const Kind& kind) {
  detail::Communicator self(MPI_COMM_SELF, nullptr);
  const DistributedCut alone(MPI_COMM_SELF, prepared, grid, {1, {}});
  return cli::solveRankFlow(self, complexFor(self, alone, kind), wind, kind.options()).flow;
}

double largestOf(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  return largest;
}

Found compare(detail::Communicator& comm, const Mesh& mesh, const Grid& grid, const Kind& kind) {
  const PreparedMesh prepared = prepare(mesh, {{1, {}}}).mesh;
  const std::array<double, 3> wind{2, 0.5, 0.25};
  const DistributedCut distributed(MPI_COMM_WORLD, prepared, grid, {1, {}});
  const RankComplex mine = complexFor(comm, distributed, kind);
  Found found;
  found.flow = cli::solveRankFlow(comm, mine, wind, kind.options());
  const CutResult whole = cut(prepared, grid, {{1, {}}});
  const CellComplex cells = wholeComplex(mesh, whole.mesh, kind);
  comm.together("comparison", [&] { requireCells(mine, comm.rank(), cells); });
  FlowOptions options;
  options.corrections = kind.corrections;
  options.farField = kind.farField;
  options.tolerance = 1e-13;
  const Flow expected = solveFlow(cells, wind, options);
  const Flow ofOne = kind.corrections > 0 || kind.farField ? flowOfOne(prepared, grid, wind, kind) : expected;
  if (expected.status != SolveStatus::converged) throw std::runtime_error("one process does not solve it");
  if (expected.throttled != found.flow.flow.throttled) throw std::runtime_error("other components are throttled");
  const double largest = largestOf(expected.phi);
  for (size_t c = 0; c < mine.cellIds.size(); ++c) {
    const size_t id = mine.cellIds[c];
    found.off = std::max(found.off, std::fabs(found.flow.flow.phi[c] - ofOne.phi[id]) / largest);
    found.missing = std::max(found.missing, std::fabs(found.flow.flow.phi[c] - expected.phi[id]) / largest);
    if (mine.cellRanks[c] != comm.rank()) continue;
    for (size_t d = 0; d < 3; ++d)
      found.speedOff = std::max(found.speedOff, std::fabs(found.flow.flow.cellVelocity[3 * c + d] - ofOne.cellVelocity[3 * id + d]));
  }
  for (double* value : {&found.off, &found.speedOff, &found.missing}) *value = comm.reduce(*value, MPI_MAX);
  found.corrections = comm.reduce(uint64_t(found.flow.corrections.size()), MPI_SUM);
  return found;
}

bool check(detail::Communicator& comm, const std::string& name, const Mesh& mesh, const Grid& grid, const Kind& kind) {
  std::string problem;
  try {
    const Found found = compare(comm, mesh, grid, kind);
    const Flow& flow = found.flow.flow;
    const bool isGood = flow.status == SolveStatus::converged && found.off <= kMostOff && found.flow.imbalance <= kMostSpilt &&
                        found.missing <= (kind.farField ? kMostFar : kMostMissing) && (found.corrections > 0) == (kind.corrections > 0);
    if (comm.rank() == 0)
      std::printf(
          "%-28s %s%s%s%s, %d levels, %s: phi off by %.1e, of solveFlow() by %.1e, velocities by %.1e, imbalance %.1e, residual %.1e, %d "
          "iterations\n",
          std::filesystem::path(name).filename().c_str(), kind.fraction > 0 ? "merged" : "as it is",
          kind.corrections > 0 ? ", corrected" : "", kind.walls > 0 ? ", walls united" : "", kind.farField ? ", far field" : "",
          kind.levels, isGood ? "as one" : "WRONG", found.off, found.missing, found.speedOff, found.flow.imbalance, flow.residuals.back(),
          found.flow.iterations);
    if (!isGood) return false;
  } catch (const std::exception& error) {
    problem = error.what();
    std::cerr << name << ", process " << comm.rank() << ": " << problem << std::endl;
  }
  return comm.reduce(problem.empty() ? 0 : 1, MPI_MAX) == 0;
}

/// Of untouched cells far from the surface no process tells the first one when cells are merged.
bool checkSent(detail::Communicator& comm) {
  constexpr uint64_t kMostForCell = 16;  // a cell and its faces would be more than 300
  const Mesh ball = shapes::icosphere({0, 0, 0}, 1, 2);
  const PreparedMesh prepared = prepare(ball, {{1, {}}}).mesh;
  const Grid grid = Grid::regular({-8, -8, -8}, {0.33, 0.33, 0.33}, {48, 48, 48});
  const DistributedCut distributed(MPI_COMM_WORLD, prepared, grid, {1, {}});
  const uint64_t before = comm.bytesSent();
  const RankComplex mine = complexFor(comm, distributed, {0.2, 0});
  const uint64_t sent = comm.reduce(comm.bytesSent() - before, MPI_SUM);
  const bool isGood = sent < kMostForCell * mine.wholeCells;
  if (comm.rank() == 0)
    std::printf("%llu bytes are sent to merge %llu cells: %s\n", static_cast<unsigned long long>(sent),
                static_cast<unsigned long long>(mine.wholeCells), isGood ? "few" : "TOO MANY");
  return isGood;
}

int checkAll(int64_t n, size_t every) {
  detail::Communicator comm(MPI_COMM_WORLD, nullptr);
  size_t checked = 0, wrong = 0;
  const auto add = [&](const std::string& name, const Mesh& mesh) {
    ++checked;
    for (const Kind& kind :
         {Kind{0, 0}, Kind{0.2, 0}, Kind{0.5, 0}, Kind{0, 8}, Kind{0.2, 8}, Kind{0, 0, 2}, Kind{0, 8, 1}, Kind{0.2, 8, 2}, Kind{0.5, 8, 24},
          Kind{0, 8, 0, 30}, Kind{0.2, 8, 2, 30}, Kind{0, 0, 0, 0, true}, Kind{0.2, 8, 2, 45, true}}) {
      if (check(comm, name, mesh, Grid::around(mesh, n, 0.3), kind)) continue;
      ++wrong;
      break;
    }
  };
  add("ball", shapes::icosphere({0, 0, 0}, 1, 3));
  add("cube", shapes::cube(0, 1));
  Mesh plate = shapes::cube(0, 1);  // some processes have no cells
  for (size_t i = 2; i < plate.positions.size(); i += 3) plate.positions[i] /= 50;
  add("plate", plate);
  add("ball and cubes", shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::cube(0.5, 1.5), shapes::cube(-3, -2)}));
  for (const std::string& file : realMeshes(every)) add(file, readMesh(file));
  if (!checkSent(comm)) ++wrong;
  if (comm.rank() == 0) std::cout << checked << " meshes, of which " << wrong << " differ" << std::endl;
  return wrong == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int64_t cells = argc > 1 ? std::atoll(argv[1]) : 13;
  const size_t every = argc > 2 ? size_t(std::atoll(argv[2])) : 25;
  const int exitCode = checkAll(cells, std::max<size_t>(every, 1));
  MPI_Finalize();
  return exitCode;
}
