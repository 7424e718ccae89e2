#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/mesh_report.h"

namespace mandoline::cli {
namespace {

/// Where the mesh meets itself, unless it can't be cut at all.
std::optional<MeshIntersections> intersectionsOf(const Mesh& mesh, const MeshInfo& info, unsigned threads) {
  if (info.triangles == 0 || info.nonFiniteVertices > 0) return std::nullopt;
  return withProgress(threads, [&](const RunOptions& options) { return findIntersections(mesh, {options, 1}); });
}

bool isLineFormat(FileFormat format) { return format == FileFormat::obj; }

}  // namespace

int runInfo(const Arguments& arguments) {
  checkOutputs(arguments, isLineFormat, "defects are written as .obj");
  const Input input = readInput(arguments);
  MeshReport report{input, inspect(input.mesh), {}};
  report.intersections = intersectionsOf(input.mesh, report.info, arguments.threads);
  deliver(
      arguments, [&] { return infoText(report); }, [&] { return infoJson(report); });
  return writeOutputs(arguments, [&](const std::string& output) {
    writeOutput(output, [&](const Sink& sink) { writeDefects(sink, input.mesh, report.info); });
  });
}

}  // namespace mandoline::cli
