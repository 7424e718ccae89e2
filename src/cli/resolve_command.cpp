#include <iostream>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/inside.h"
#include "cli/mesh_report.h"
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

/// What there is to tell of it.
struct ResolveReport {
  const MeshReport& mesh;
  const ResolveResult& result;
  size_t triangles = 0;  ///< written

  std::string text() const {
    return headline(mesh) + "Pairs of triangles that met: " + describePairs(result.stats.intersections) +
           "\nAfter the rounding of vertices: " + describePairs(result.remaining) + "\nTriangles written: " + std::to_string(triangles) +
           "\n";
  }
  std::string json(const Outcome& outcome) const {
    Json json;
    addHead(json, outcome, mesh);
    if (result) {
      addPairs(json, "intersections", result.stats.intersections);
      json.close('}');
      addPairs(json, "remaining", result.remaining);
      json.close('}');
    } else {
      json.key("intersections").null().key("remaining").null();
    }
    return json.member("triangles", triangles).close('}').text();
  }
};

}  // namespace

int runResolve(const Arguments& arguments) {
  checkOutputs(arguments, isMeshFormat, "a mesh is written as .obj, .stl, .ply or .off");
  const Input input = readInput(arguments);
  const ResolveResult result = withProgress(arguments.threads, [&](const RunOptions& options) { return resolve(input.mesh, options); });
  const MeshReport meshReport{input, inspect(input.mesh), {}};
  ResolveReport report{meshReport, result};
  const auto fail = [&](const Outcome& outcome) { return failWith(arguments, input.name, outcome, [&] { return report.json(outcome); }); };
  if (!result) return fail(result.error);
  const std::string how = arguments.rule ? describeInside(std::nullopt, result.stats.parts) : "";
  if (arguments.rule && !result.mesh.hasWinding && result.mesh.frontParity.empty()) {
    return fail({"badArgument",
                 "No part of the mesh is closed, so that it bounds no solid: " + how + ". 'mandoline boundary' closes it by an estimate."});
  }
  if (!how.empty()) std::cerr << "Note: " << how << "\n";
  const Mesh written = arguments.rule ? boundary(result.mesh, *arguments.rule) : result.mesh.mesh;
  const TriangleGroups groups = arguments.rule ? TriangleGroups() : groupsOf(result.mesh, input.groups);
  report.triangles = written.triangleCount();
  int exitCode = kFine;
  attempt(exitCode, [&] {
    writeReport(arguments, [&] { return report.json({}); });
    if (arguments.report.empty()) std::cerr << report.text();
  });
  const auto write = [&](const std::string& output) {
    writeOutput(output, [&](const Sink& sink) { writeMesh(sink, formatFor(arguments, output), written, {}, &groups); });
  };
  return writeOutputs(arguments, write, exitCode);
}

}  // namespace mandoline::cli
