#include <algorithm>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/inside.h"
#include "mandoline/resolve.h"

namespace mandoline::cli {
namespace {

/// What there is to tell of it.
struct BoundaryReport {
  const MeshReport& mesh;
  const PartCounts& parts;
  const std::optional<InsideRegions>& inside;
  size_t regions = 0, allRegions = 0;  ///< whose boundary is written, of how many
  size_t triangles = 0;                ///< written

  std::string text() const {
    return headline(mesh) + "Boundary of " + std::to_string(regions) + " of " + std::to_string(allRegions) +
           " regions\nTriangles written: " + std::to_string(triangles) + "\n";
  }
  std::string json(const Outcome& outcome) const {
    Json json;
    addHead(json, outcome, mesh);
    addInside(json, parts, inside);
    return json.member("triangles", triangles).close('}').text();
  }
};

int failWithNothing(const Arguments& arguments, const BoundaryReport& report) {
  const std::string how = describeInside(report.inside, report.parts);
  Outcome outcome("nothingInside", "Nothing is inside" + (how.empty() ? "" : ": " + how) + ".");
  if (report.inside && report.inside->by == InsideBy::estimate)
    outcome.message += " With a lower --inside-threshold more counts as inside.";
  return failWith(arguments, report.mesh.input.name, outcome, [&] { return report.json(outcome); });
}

}  // namespace

int runBoundary(const Arguments& arguments) {
  checkOutputs(arguments, isMeshFormat, "a mesh is written as .obj, .stl, .ply or .off");
  const Input input = readInput(arguments);
  const std::optional<CutResult> cut = cutOrComplain(arguments, input, arguments.grid);
  if (!cut) return kNotCut;
  const MeshReport mesh{input, inspect(input.mesh), {}};
  const std::optional<InsideRegions> inside = insideOf(arguments, cut->mesh);
  BoundaryReport report{mesh, cut->stats.parts, inside};
  if (!arguments.only.any() && !isAnyInside(inside)) return failWithNothing(arguments, report);
  const WriteOptions options = writeOptions(arguments, *cut);
  requireSelection(options, cut->mesh);
  const Mesh written = boundary(cut->mesh, options.regions);
  report.regions = size_t(std::count(options.regions.begin(), options.regions.end(), 1));
  report.allRegions = options.regions.size();
  report.triangles = written.triangleCount();
  int exitCode = kFine;
  attempt(exitCode, [&] {
    deliver(
        arguments, [&] { return report.text(); }, [&] { return report.json({}); });
  });
  const auto write = [&](const std::string& output) {
    writeOutput(output, [&](const Sink& sink) { writeMesh(sink, formatFor(arguments, output), written); });
  };
  return writeOutputs(arguments, write, exitCode);
}

}  // namespace mandoline::cli
