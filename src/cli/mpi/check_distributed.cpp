#include "cli/mpi/check_distributed.h"

#include "cli/cut_command.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/mpi/case_files.h"
#include "cli/mpi/mcm_folder.h"
#include "cli/mpi/piece_files.h"
#include "io/output_file.h"

#ifdef MANDOLINE_HAVE_PETSC
#include "cli/mpi/distributed_flow.h"
#endif

namespace mandoline::cli {
namespace {

/// Refuses what pieces do not go with.
void checkPieces(const Arguments& arguments, const std::string& output) {
  const OnlyArguments& only = arguments.only;
  const bool isCase = isPolyMesh(output);
  const std::string kind = isCase ? "polyMeshes of several processes" : ".pvtu files";
  if (output.find(kRegionMark) != std::string::npos) throw UsageError("-o " + output + ": " + kind + " have all regions");
  refuseOptions({{arguments.refines(), arguments.refineOption()},
                 {arguments.faces, "--faces"},
                 {arguments.insideThreshold.has_value(), "--inside-threshold"},
                 {only.inside || only.outside, "--only inside and outside"},
                 {isCase && only.any(), "--only"}},
                "-o " + output + ": " + kind + " do not go with ", ": that needs the whole cut");
}

/// A folder of pieces has all of the cut, as any .mcm file, and nothing that is made of it.
void checkMcmFolder(const Arguments& arguments, const std::string& output) {
  if (arguments.only.any()) throw UsageError("-o " + output + ": .mcm files always have everything");
  if (arguments.insideThreshold) throw UsageError("-o " + output + ": pieces do not go with --inside-threshold, which needs the whole cut");
}

void checkFlow([[maybe_unused]] const Arguments& arguments) {
#ifdef MANDOLINE_HAVE_PETSC
  checkDistributedFlow(arguments);
#else
  throw UsageError("this program was built without PETSc or Eigen, which flow needs in several processes");
#endif
}

}  // namespace

void checkDistributed(const Arguments& arguments) {
  if (arguments.stream) throw UsageError("--stream: one process alone streams. A .pvtu file has a piece of each process");
  if (arguments.snapTolerance > 0) throw UsageError("--snap-tolerance: several processes do not snap");
  if (arguments.command == Command::flow) return checkFlow(arguments);
  for (const std::string& output : arguments.outputs) {
    if (!isInPieces(output)) continue;
    if (isMcmFolder(output)) {
      checkMcmFolder(arguments, output);
      continue;
    }
    checkPieces(arguments, output);
    if (isPvtu(output))
      detail::checkPlace(output);
    else
      checkCase(output);
  }
  Arguments others = arguments;
  if (std::erase_if(others.outputs, isPvtu) > 0) {  // the .pvtu file has what these ask for
    others.simpleCells = false;
    others.coarsen.reset(), others.merge.reset(), others.uniteWalls.reset();
  }
  std::erase_if(others.outputs, isMcmFolder);
  checkCutOutputs(others);
}

bool isInPieces(const std::string& output) { return isPvtu(output) || isPolyMesh(output) || isMcmFolder(output); }

Arguments ofWhole(const Arguments& arguments) {
  Arguments whole = arguments;
  std::erase_if(whole.outputs, isInPieces);
  return whole;
}

bool needsWhole(const Arguments& arguments) {
  return !ofWhole(arguments).outputs.empty() || arguments.validate || arguments.refines() || needsInside(arguments);
}

}  // namespace mandoline::cli
