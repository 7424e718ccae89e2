#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/report.h"

namespace mandoline::cli {
namespace {

/// Where the mesh meets itself, unless it can't be cut at all.
std::optional<MeshIntersections> intersectionsOf(const Mesh& mesh, const MeshInfo& info, unsigned threads) {
  if (info.triangles == 0 || info.nonFiniteVertices > 0) return std::nullopt;
  return withProgress(threads, [&](const RunOptions& options) { return findIntersections(mesh, {options, 1}); });
}

}  // namespace

int runInfo(const Arguments& arguments) {
  if (arguments.mesh != "-" && !arguments.report.empty()) requireDifferent({{"the mesh", arguments.mesh}, {"--report", arguments.report}});
  GroupedMesh input = readGroupedInput(arguments.mesh);
  MeshReport report{nameOf(arguments.mesh), inspect(input.mesh), {}, std::move(input.groups)};
  report.intersections = intersectionsOf(input.mesh, report.info, arguments.threads);
  const bool asText = arguments.report.empty();
  writeOutput(asText ? "-" : arguments.report, [&](const Sink& sink) { sink(asText ? infoText(report) : infoJson(report)); });
  return kFine;
}

}  // namespace mandoline::cli
