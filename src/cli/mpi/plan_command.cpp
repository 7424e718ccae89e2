#include "cli/mpi/plan_command.h"

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/mpi/distributed_cut.h"
#include "cli/peak_memory.h"
#include "cli/values.h"
#include "cut/share_plan.h"
#include "mesh/read/load_file.h"

namespace mandoline::cli {
namespace {

constexpr uint32_t kMostRanks = 100000;

/// What MPI takes for messages: as measured with Open MPI on one machine, where it is more for each other process there.
uint64_t messageBytes(uint32_t ranks) {
  constexpr uint64_t kAlways = 2 << 20, kEach = 3 << 17;
  constexpr uint32_t kMostOthers = 16;
  return ranks == 1 ? 0 : kAlways + kEach * std::min(ranks - 1, kMostOthers);
}

/// Takes --ranks P,P... out of the words. Throws UsageError.
std::vector<uint32_t> takeRanks(std::vector<std::string>& words) {
  std::optional<std::string> value;
  for (auto word = words.begin(); word != words.end();) {
    const bool isAttached = word->starts_with("--ranks=");
    if (!isAttached && *word != "--ranks") {
      ++word;
      continue;
    }
    if (value) throw UsageError("--ranks is given twice");
    const auto next = word + 1;
    value = isAttached ? word->substr(word->find('=') + 1) : next != words.end() ? *next : "";
    word = words.erase(word, isAttached || next == words.end() ? next : next + 1);
  }
  if (!value) throw UsageError("--ranks is missing");
  const std::vector<uint32_t> ranks = parseList<uint32_t>(*value);
  const bool areFit = !ranks.empty() && std::all_of(ranks.begin(), ranks.end(), [](uint32_t p) { return p >= 1 && p <= kMostRanks; });
  if (!areFit) throw UsageError("--ranks needs numbers of processes from 1 to 100000, not '" + *value + "'");
  return ranks;
}

void checkPlanArguments(const Arguments& arguments) {
  refuseOptions({{!arguments.outputs.empty(), "-o"},
                 {arguments.stream, "--stream"},
                 {arguments.snapTolerance > 0, "--snap-tolerance"},
                 {arguments.validate, "--validate"},
                 {arguments.only.any() || arguments.insideThreshold, "--only and --inside-threshold"},
                 {arguments.coarsen || arguments.faces, "--coarsen and --faces"},
                 {arguments.merge || arguments.uniteWalls, "--merge and --unite-walls"},
                 {arguments.refines(), "--refine and --refine-box"}},
                "", ": a plan is that of cut alone");
}

/// What there is to tell of a number of processes: the most that one of them has.
struct RankPlan {
  uint32_t ranks;
  uint32_t busy = 0;  ///< that have any cut-cells
  detail::ShareLoad most;
  double balance = 0, workBalance = 0;  ///< the most cut-cells over their average, and the most work

  RankPlan(const std::vector<detail::ShareLoad>& loads, uint64_t programBytes) : ranks(uint32_t(loads.size())) {
    uint64_t cells = 0, work = 0;
    for (const detail::ShareLoad& load : loads) {
      busy += load.cutCells > 0;
      cells += load.cutCells;
      work += load.work;
      for (const auto member : {&detail::ShareLoad::work, &detail::ShareLoad::cutCells, &detail::ShareLoad::faces,
                                &detail::ShareLoad::seamFaces, &detail::ShareLoad::bytesSent, &detail::ShareLoad::memoryBytes}) {
        most.*member = std::max(most.*member, load.*member);
      }
    }
    most.memoryBytes += programBytes + messageBytes(ranks);
    balance = cells == 0 ? 1 : double(most.cutCells) * ranks / double(cells);
    workBalance = work == 0 ? 1 : double(most.work) * ranks / double(work);
  }
};

struct PlanReport {
  const Arguments& arguments;
  const MeshReport& mesh;
  const AskedGrid& grid;
  std::vector<RankPlan> plans;

  std::string text() const {
    std::ostringstream out;
    out << headline(mesh) << headline(grid) << "\nThe most that one process has\n"
        << std::setw(8) << "ranks" << std::setw(10) << "with work" << std::setw(12) << "cut-cells" << std::setw(12) << "faces"
        << std::setw(12) << "seam faces" << std::setw(13) << "memory (MB)" << std::setw(12) << "sent (MB)" << std::setw(10) << "balance"
        << std::setw(10) << "of work"
        << "\n"
        << std::fixed << std::setprecision(2);
    for (const RankPlan& plan : plans) {
      out << std::setw(8) << plan.ranks << std::setw(10) << plan.busy << std::setw(12) << plan.most.cutCells << std::setw(12)
          << plan.most.faces << std::setw(12) << plan.most.seamFaces << std::setw(13) << double(plan.most.memoryBytes) / 1e6
          << std::setw(12) << double(plan.most.bytesSent) / 1e6 << std::setw(10) << plan.balance << std::setw(10) << plan.workBalance
          << "\n";
    }
    const bool areIdle = std::any_of(plans.begin(), plans.end(), [](const RankPlan& plan) { return plan.busy < plan.ranks; });
    if (areIdle) out << "Processes get whole layers of grid cells along z: those beyond the layers that the mesh touches have no work.\n";
    return out.str();
  }
  std::string json(const Outcome& outcome) const {
    Json json;
    addHead(json, outcome, mesh);
    addGrid(json, grid);
    json.key("plan").open('[');
    for (const RankPlan& plan : plans) {
      json.open('{').member("ranks", plan.ranks).member("ranksWithWork", plan.busy).member("cutCells", plan.most.cutCells);
      json.member("faces", plan.most.faces).member("seamFaces", plan.most.seamFaces).member("memoryBytes", plan.most.memoryBytes);
      json.member("bytesSent", plan.most.bytesSent).member("balance", plan.balance).member("workBalance", plan.workBalance).close('}');
    }
    return json.close(']').close('}').text();
  }
};

/// Adds what is sent of the mesh: by the first process to all others together if these do not read the file, and of slices.
void addMesh(bool isBinary, const MeshView& mesh, std::vector<detail::ShareLoad>& loads) {
  if (!isBinary) loads[0].bytesSent += (mesh.positions.size_bytes() + mesh.triangles.size_bytes()) * (loads.size() - 1) / loads.size();
  if (isBinary && readsFileInAll(loads.size())) return;
  for (detail::ShareLoad& load : loads) load.bytesSent += load.sliceBytes;
}

int plan(const Arguments& arguments, const std::vector<uint32_t>& ranks) {
  requireDifferent(filesBesideOutputs(arguments));
  const uint64_t programBytes = peakMemoryBytes();
  const Input input = readInput(arguments);
  const MeshReport mesh{input, inspect(input.mesh), {}};
  const AskedGrid grid = makeGrid(arguments.grid, input.mesh);
  PlanReport report{arguments, mesh, grid, {}};
  Error error;
  withProgress(arguments.threads, [&](const RunOptions& options) {
    const PrepareResult prepared = prepare(input.mesh, {options, arguments.intersections});
    error = prepared.error;
    if (!prepared) return;
    try {
      detail::SharePlanner planner(prepared.mesh, grid.grid, options);
      const bool isBinary = detail::isBinaryMesh(arguments.mesh);
      for (const uint32_t count : ranks) {
        std::vector<detail::ShareLoad> loads = planner.loads(count, options);
        addMesh(isBinary, input.mesh, loads);
        report.plans.push_back({loads, programBytes});
      }
    } catch (const CallError& failed) {
      error = failed.error;
    }
  });
  if (error.status != Status::ok)
    return failWith(arguments, input.name, withSize(error, arguments, grid), [&] { return report.json(withSize(error, arguments, grid)); });
  deliver(
      arguments, [&] { return report.text(); }, [&] { return report.json({}); });
  return kFine;
}

}  // namespace

int runPlan(Ranks& ranks, std::vector<std::string> words) {
  int exitCode = kFine;
  ranks.inFirst([&] {
    const std::vector<uint32_t> counts = takeRanks(words);
    words.insert(words.begin(), "cut");
    const Arguments arguments = parseArguments(words);
    if (arguments.command != Command::cut) throw UsageError("Try mandoline-mpi help");
    checkPlanArguments(arguments);
    exitCode = plan(arguments, counts);
  });
  return ranks.comm().reduce(exitCode, MPI_MAX);
}

}  // namespace mandoline::cli
