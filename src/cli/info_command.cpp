#include "cli/commands.h"
#include "cli/files.h"
#include "cli/report.h"

namespace mandoline::cli {

int runInfo(const Arguments& arguments) {
  if (arguments.mesh != "-" && !arguments.report.empty()) requireDifferent({{"the mesh", arguments.mesh}, {"--report", arguments.report}});
  const Mesh mesh = readInput(arguments.mesh);
  const MeshReport report{nameOf(arguments.mesh), inspect(mesh)};
  const bool asText = arguments.report.empty();
  writeOutput(asText ? "-" : arguments.report, [&](const Sink& sink) { sink(asText ? infoText(report) : infoJson(report)); });
  return kFine;
}

}  // namespace mandoline::cli
