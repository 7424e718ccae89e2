// cut --stream: the pieces of a cut, one by one, into a folder.
#include <chrono>
#include <iomanip>
#include <sstream>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/peak_memory.h"

namespace mandoline::cli {
namespace {

/// What is told of the cut.
struct StreamReport {
  const MeshReport& mesh;
  const AskedGrid& grid;
  Outcome outcome;
  PieceCounts counts;
  double totalMs = 0;
};

std::string reportJson(const StreamReport& report) {
  Json json;
  addHead(json, report.outcome, report.mesh);
  addGrid(json, report.grid);
  json.member("pieces", report.counts.pieces).member("cutCells", report.counts.cutCells);
  json.member("untouchedCells", report.counts.untouchedCells);
  json.member("totalMs", report.totalMs).member("peakMemoryBytes", peakMemoryBytes()).close('}');
  return json.text();
}

std::string reportText(const StreamReport& report) {
  std::ostringstream out;
  out << headline(report.mesh) << headline(report.grid) << "\n";
  const auto add = [&](const char* label, auto value) {
    out << "  " << std::left << std::setw(26) << label << std::right << std::setw(12) << value << "\n";
  };
  add("pieces", report.counts.pieces);
  add("cut-cells", report.counts.cutCells);
  if (report.counts.untouchedCells > 0) add("untouched grid cells", report.counts.untouchedCells);
  out << std::fixed << std::setprecision(2);
  add("total (ms)", report.totalMs);
  add("Peak memory (MB)", double(peakMemoryBytes()) / 1e6);
  return out.str();
}

/// What can be told before there is a mesh.
void checkArguments(const Arguments& arguments) {
  if (arguments.outputs.size() != 1 || arguments.outputs[0] == "-") throw UsageError("--stream needs -o with one folder");
  const std::string& folder = arguments.outputs[0];
  if (formatOf(folder) || isPolyMesh(folder) || folder.find(kRegionMark) != std::string::npos)
    throw UsageError("-o " + folder + ": --stream writes a folder of .vtu files");
  const OnlyArguments& only = arguments.only;
  refuseOptions({{arguments.validate, "--validate"},
                 {arguments.coarsen.has_value(), "--coarsen"},
                 {arguments.merge.has_value(), "--merge"},
                 {arguments.uniteWalls.has_value(), "--unite-walls"},
                 {arguments.faces, "--faces"},
                 {arguments.insideThreshold.has_value(), "--inside-threshold"},
                 {arguments.refines(), arguments.refineOption()},
                 {arguments.snapTolerance > 0, "--snap-tolerance"},
                 {only.inside || only.outside || !only.regions.empty(), "--only other than cut"}},
                "--stream does not go with ", ", which needs the whole cut");
  std::vector<NamedFile> files = filesBesideOutputs(arguments);
  files.push_back({"-o", folder});
  requireDifferent(files);
}

/// Prepares the mesh, and forgets it.
PreparedMesh prepared(const Arguments& arguments, Mesh& mesh) {
  const PrepareResult result = withProgress(arguments.threads, [&](const RunOptions& run) {
    return prepare(mesh, {run, arguments.intersections});
  });
  if (!result) throw CallError(result.error);
  mesh = {};
  return result.mesh;
}

PieceCounts writePieces(const Arguments& arguments, const PreparedMesh& mesh, const Grid& grid) {
  return withProgress(arguments.threads, [&](const RunOptions& run) {
    WritePiecesOptions options{{run}};
    options.untouched = !arguments.only.cut;
    options.simpleCells = arguments.simpleCells;
    return mandoline::writePieces(arguments.outputs[0], mesh, grid, options);
  });
}

}  // namespace

int runStream(const Arguments& arguments) {
  checkArguments(arguments);
  const auto start = std::chrono::steady_clock::now();
  Input input = readInput(arguments);
  const MeshReport mesh{input, inspect(input.mesh), {}};
  const AskedGrid grid = makeGrid(arguments.grid, input.mesh);
  StreamReport report{mesh, grid, {}, {}, 0};
  try {
    report.counts = writePieces(arguments, prepared(arguments, input.mesh), grid.grid);
  } catch (const CallError& error) {
    report.outcome = withSize(error.error, arguments, grid);
    return failWith(arguments, input.name, report.outcome, [&] { return reportJson(report); });
  }
  report.totalMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  deliver(
      arguments, [&] { return reportText(report); }, [&] { return reportJson(report); });
  if (report.counts.pieces > 0) return kFine;
  complain("--only cut selects nothing: the surface touches no grid cell");
  return kBadUsageOrFile;
}

}  // namespace mandoline::cli
