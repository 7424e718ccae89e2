// The command line for several processes: each cuts its share.
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <thread>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/limit_memory.h"
#include "cli/mpi/distributed_cut.h"
#include "cli/mpi/plan_command.h"
#include "cli/progress_bar.h"
#include "mandoline/distributed.h"

namespace mandoline::cli {
namespace {

constexpr const char* kMpiHelp =
    R"(Cuts a triangle mesh with a grid in several processes, each of which keeps its piece.

  mpirun -n P mandoline-mpi cut MESH [options of mandoline cut] [--progress] [-o FILE ...]
  mpirun -n P mandoline-mpi flow MESH --wind X,Y,Z [options of mandoline flow]
                              [--progress] -o FILE ...
  mandoline-mpi plan MESH --ranks P[,P...] [options of the grid] [--report FILE]

The result is that of mandoline cut, to the bit, for any P; see mandoline --help for the
options. Each process reads its share of the mesh and cuts some layers of the grid.

  -o FILE.pvtu           a .vtu file of each process, FILE_0.vtu and so on, and FILE.pvtu,
                         which joins them; with --only also cut and region=K
  -o CASE/constant/polyMesh
                         a decomposed case of OpenFOAM: CASE/processor0/constant/polyMesh
                         and so on, of all cells. These and .pvtu files take --coarsen,
                         --merge and --unite-walls, but not --refine
  -o FOLDER.mcm/         a .mcm file of each process, FOLDER.mcm/piece_0.mcm and so on;
                         readCutMesh() takes each of them, or the folder for the whole.
                         Other files are written by the first process, which then has to
                         hold the whole cut, as it has to for --validate and --only inside
  --threads T            of each process (default: the cores of its machine, shared out)
  --progress             show how far the first process has come, on standard error

flow solves the potential flow by PETSc, where the program was built with it, as mandoline
flow does; the first process gathers the whole and writes it. PETSC_OPTIONS chooses other
solvers. Not with --refine and --steps.

plan tells what the busiest of P processes, up to 100000, would have of a cut: cut-cells,
faces and how many of these it shares with others, memory, what it sends, and how many times
the average cut-cells and estimated work are. One process cuts all for that, once for each P,
and keeps no result.

cut does not go with --stream and --snap-tolerance. The report has the cut-cells, time, peak memory
and bytes sent of each process, in JSON as ranks.
)";

/// Takes --progress out of the words.
void takeProgress(std::vector<std::string>& words, bool isFirst) {
  const bool isAsked = std::erase(words, "--progress") > 0;
  if (isAsked || !isFirst) showProgress(isFirst && isAsked);
}

int run(Ranks& ranks, std::vector<std::string> words) {
  takeProgress(words, ranks.isFirst());
  const bool asksForHelp = std::count(words.begin(), words.end(), "--help") + std::count(words.begin(), words.end(), "-h") > 0;
  if (!words.empty() && words[0] == "plan" && !asksForHelp) return runPlan(ranks, {words.begin() + 1, words.end()});
  Arguments arguments;
  ranks.together([&] { arguments = parseArguments(words); });
  switch (arguments.command) {
    case Command::help:
      if (ranks.isFirst()) std::cout << kMpiHelp;
      return kFine;
    case Command::version:
      if (ranks.isFirst()) std::cout << "mandoline-mpi " << MANDOLINE_VERSION << "\n";
      return kFine;
    case Command::cut:
    case Command::flow:
      break;
    default:
      ranks.inFirst([] { throw UsageError("several processes cut and solve flows; mandoline has the other commands"); });
  }
  const int here = ranks.onThisMachine();
  limitMemory(here);
  if (arguments.threads == 0) arguments.threads = std::max(1u, std::thread::hardware_concurrency() / unsigned(here));
  return runDistributedCut(ranks, arguments);
}

[[noreturn]] void endInterrupted(const Ranks& ranks, int signal) {
  if (ranks.isFirst()) complain("interrupted");
  _exit(128 + signal);  // what others began can't be finished
}

/// Runs the command. Of what the other processes can't learn, this one ends all.
int runAll(const std::vector<std::string>& words) {
  Ranks ranks;
  try {
    try {
      return run(ranks, words);
    } catch (const CallError&) {  // of a call that was cancelled, too
      throwIfInterrupted();
      throw;
    }
  } catch (const Stopped& stopped) {
    return stopped.exitCode;
  } catch (const Interrupted& interrupted) {
    endInterrupted(ranks, interrupted.signal);
  } catch (const RankError& error) {
    if (ranks.isFirst()) complain("rank " + std::to_string(error.rank) + ": " + error.what());
    return kNotCut;
  } catch (...) {
    const int exitCode = complainOfException(ranks.rank());
    MPI_Abort(MPI_COMM_WORLD, exitCode);
    return exitCode;
  }
}

}  // namespace

void complain(const std::string& message) { std::cerr << "mandoline-mpi: " << message << std::endl; }

}  // namespace mandoline::cli

int main(int argc, char** argv) {
  using namespace mandoline::cli;
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  handleInterrupts();
  const int exitCode = runAll(std::vector<std::string>(argv + 1, argv + argc));
  MPI_Finalize();
  return exitCode;
}
