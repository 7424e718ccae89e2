// Compares flows by several processes with those of one. Run by MPI in any number of processes:
//
//   mandoline-mpi-flows CELLS EVERY
//
// as mandoline-mpi-pieces. Both solve the same system; they differ by what their solvers leave of the residual.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "cli/mpi/flow/rank_flow.h"
#include "mandoline/io.h"
#include "real_meshes.h"
#include "shapes.h"

using namespace mandoline;

namespace {

constexpr double kMostOff = 1e-9;     // of phi, of the largest
constexpr double kMostSpilt = 1e-12;  // of what flows into a cell, of the largest flow through a face

struct Found {
  double off = 0, speedOff = 0;
  cli::RankFlow flow;
};

Found compare(detail::Communicator& comm, const Mesh& mesh, const Grid& grid) {
  const PreparedMesh prepared = prepare(mesh, {{1, {}}}).mesh;
  const std::array<double, 3> wind{2, 0.5, 0.25};
  const DistributedCut distributed(MPI_COMM_WORLD, prepared, grid, {1, {}});
  const RankComplex mine = distributed.cellComplex(distributed.piece(), cli::kFlowGhosts);
  Found found;
  found.flow = cli::solveRankFlow(comm, mine, wind);
  const CutResult whole = cut(prepared, grid, {{1, {}}});
  CoarsenOptions coarsening;
  coarsening.maxLevel = 0;
  const CellComplex cells = cellComplex(mesh, whole.mesh, coarsen(whole.mesh, coarsening));
  FlowOptions options;
  options.corrections = 0;
  options.tolerance = 1e-13;
  const Flow expected = solveFlow(cells, wind, options);
  if (expected.status != SolveStatus::converged) throw std::runtime_error("one process does not solve it");
  if (expected.throttled != found.flow.flow.throttled) throw std::runtime_error("other components are throttled");
  double largest = 0;
  for (const double phi : expected.phi) largest = std::max(largest, std::fabs(phi));
  for (size_t c = 0; c < mine.cellIds.size(); ++c) {
    const size_t id = mine.cellIds[c];
    found.off = std::max(found.off, std::fabs(found.flow.flow.phi[c] - expected.phi[id]) / largest);
    if (mine.cellRanks[c] != comm.rank()) continue;
    for (size_t d = 0; d < 3; ++d)
      found.speedOff = std::max(found.speedOff, std::fabs(found.flow.flow.cellVelocity[3 * c + d] - expected.cellVelocity[3 * id + d]));
  }
  found.off = comm.reduce(found.off, MPI_MAX);
  found.speedOff = comm.reduce(found.speedOff, MPI_MAX);
  return found;
}

bool check(detail::Communicator& comm, const std::string& name, const Mesh& mesh, const Grid& grid) {
  std::string problem;
  try {
    const Found found = compare(comm, mesh, grid);
    const Flow& flow = found.flow.flow;
    const bool isGood = flow.status == SolveStatus::converged && found.off <= kMostOff && found.flow.imbalance <= kMostSpilt;
    if (comm.rank() == 0)
      std::printf("%-28s %s: phi off by %.1e, velocities by %.1e, imbalance %.1e, residual %.1e, %d iterations\n",
                  std::filesystem::path(name).filename().c_str(), isGood ? "as one" : "WRONG", found.off, found.speedOff,
                  found.flow.imbalance, flow.residuals.back(), found.flow.iterations);
    if (!isGood) return false;
  } catch (const std::exception& error) {
    problem = error.what();
    std::cerr << name << ", process " << comm.rank() << ": " << problem << std::endl;
  }
  return comm.reduce(problem.empty() ? 0 : 1, MPI_MAX) == 0;
}

int checkAll(int64_t n, size_t every) {
  detail::Communicator comm(MPI_COMM_WORLD, nullptr);
  size_t checked = 0, wrong = 0;
  const auto add = [&](const std::string& name, const Mesh& mesh) {
    ++checked;
    wrong += !check(comm, name, mesh, Grid::around(mesh, n, 0.3));
  };
  add("ball", shapes::icosphere({0, 0, 0}, 1, 3));
  add("cube", shapes::cube(0, 1));
  add("ball and cubes", shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::cube(0.5, 1.5), shapes::cube(-3, -2)}));
  for (const std::string& file : realMeshes(every)) add(file, readMesh(file));
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
