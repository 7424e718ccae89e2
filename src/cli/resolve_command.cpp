#include <iostream>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/report.h"
#include "mandoline/resolve.h"

namespace mandoline::cli {
namespace {

/// Those of the triangles that a mesh was resolved from; none if there are none.
TriangleGroups groupsOf(const ResolvedMesh& resolved, const TriangleGroups& groups) {
  TriangleGroups result;
  if (groups.empty()) return result;
  result.names = groups.names;
  for (size_t t = 0; t < resolved.mesh.triangleCount(); ++t) {
    result.triangleGroup.push_back(groups.triangleGroup[resolved.parents[resolved.parentOffsets[t]]]);
  }
  return result;
}

}  // namespace

int runResolve(const Arguments& arguments) {
  checkOutputs(arguments, isMeshFormat, "a mesh is written as .obj, .stl, .ply or .off");
  const GroupedMesh input = readGroupedInput(arguments.mesh);
  const ResolveResult result = withProgress(arguments.threads, [&](const RunOptions& options) { return resolve(input.mesh, options); });
  if (!result) {
    complain(refusal(nameOf(arguments.mesh), result.error));
    return kNotCut;
  }
  if (arguments.rule && !result.mesh.hasWinding) {
    complain(nameOf(arguments.mesh) + ": the mesh is open or not consistently oriented, so that it bounds no solid");
    return kNotCut;
  }
  const Mesh written = arguments.rule ? boundary(result.mesh, *arguments.rule) : result.mesh.mesh;
  const TriangleGroups groups = arguments.rule ? TriangleGroups() : groupsOf(result.mesh, input.groups);
  const int exitCode = writeOutputs(arguments, [&](const std::string& output) {
    writeOutput(output, [&](const Sink& sink) { writeMesh(sink, formatFor(arguments, output), written, {}, &groups); });
  });
  const PairCounts &met = result.stats.intersections, &left = result.remaining;
  std::cerr << "Pairs of triangles that met: " << describePairs(met) << "\n"
            << "After the rounding of vertices: " << describePairs(left) << "\n"
            << "Triangles written: " << written.triangleCount() << "\n";
  return exitCode;
}

}  // namespace mandoline::cli
