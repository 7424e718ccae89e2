#include "cli/cutting.h"

#include <algorithm>
#include <iostream>

#include "cli/commands.h"
#include "cli/files.h"
#include "cli/inside.h"
#include "cli/peak_memory.h"
#include "io/output_file.h"

namespace mandoline::cli {
namespace {

constexpr double kThreshold = InsideOptions().threshold;

/// Whether a command works on what is inside unless --only says otherwise.
bool isInsideDefault(const Arguments& arguments) {
  return (arguments.command == Command::slice || arguments.command == Command::boundary) && !arguments.only.any();
}

}  // namespace

std::vector<NamedFile> filesBesideOutputs(const Arguments& arguments) {
  std::vector<NamedFile> files;
  if (!arguments.mesh.empty() && arguments.mesh != "-") files.push_back({"the mesh", arguments.mesh});
  if (!arguments.report.empty() && arguments.report != "-") detail::checkPlace(arguments.report);
  if (!arguments.report.empty()) files.push_back({"--report", arguments.report});
  return files;
}

void checkOutputs(const Arguments& arguments, bool (*isAllowed)(FileFormat), const std::string& rule) {
  std::vector<NamedFile> files = filesBesideOutputs(arguments);
  for (const std::string& output : arguments.outputs) {
    const std::optional<FileFormat> format = output == "-" ? arguments.format : formatOf(output);
    if (!format || !isAllowed(*format)) throw UsageError(output + ": " + rule);
    if (output.find(kRegionMark) != std::string::npos) throw UsageError(output + ": only cut writes a file for each region");
    if (output != "-") detail::checkPlace(output);
    files.push_back({"-o", output});
  }
  requireDifferent(files);
}

void attempt(int& exitCode, const std::function<void()>& work) {
  try {
    work();
  } catch (const FileError& error) {
    complain(error.what());
    exitCode = kBadUsageOrFile;
  } catch (const UsageError& error) {
    complain(error.what());
    exitCode = kBadUsageOrFile;
  } catch (const CallError& error) {
    complain(error.what());
    if (exitCode == kFine) exitCode = kNotCut;
  }
}

int writeOutputs(const Arguments& arguments, const std::function<void(const std::string&)>& write, int exitCode) {
  for (const std::string& output : arguments.outputs) attempt(exitCode, [&] { write(output); });
  return exitCode;
}

bool takesStandardOutput(const Arguments& arguments) {
  return std::find(arguments.outputs.begin(), arguments.outputs.end(), "-") != arguments.outputs.end();
}

void writeReport(const Arguments& arguments, const std::function<std::string()>& json) {
  if (!arguments.report.empty()) writeOutput(arguments.report, [&](const Sink& sink) { sink(json()); });
}

int failWith(const Arguments& arguments, const std::string& meshName, const Outcome& outcome, const std::function<std::string()>& json) {
  complain(refusal(meshName, outcome));
  writeReport(arguments, json);
  return kNotCut;
}

void deliver(const Arguments& arguments, const std::function<std::string()>& text, const std::function<std::string()>& json) {
  if (!arguments.report.empty()) return writeReport(arguments, json);
  if (!takesStandardOutput(arguments)) return writeOutput("-", [&](const Sink& sink) { sink(text()); });
  std::cerr << text() << std::flush;
}

/// How many cells were asked for.
static std::string sizeOf(const GridArguments& asked, const std::array<int64_t, 3>& cells) {
  if (asked.oneNumber) return std::to_string((*asked.cells)[0]) + " cells along the longest side";
  return std::to_string(cells[0]) + " x " + std::to_string(cells[1]) + " x " + std::to_string(cells[2]) + " cells";
}

Error withSize(Error error, const Arguments& arguments, const AskedGrid& asked) {
  if (error.status == Status::gridTooLarge) error.message += " Asked for were " + sizeOf(arguments.grid, asked.cells) + ".";
  return error;
}

bool needsInside(const Arguments& arguments) {
  const OnlyArguments& only = arguments.only;
  return only.inside || only.outside || isInsideDefault(arguments) || arguments.insideThreshold;
}

CutResult cutMesh(const Arguments& arguments, const Mesh& mesh, const AskedGrid& asked) {
  CutResult result = withProgress(arguments.threads, [&](const RunOptions& options) {
    return cut(mesh, asked.grid, {options, arguments.snapTolerance, arguments.intersections});
  });
  result.error = withSize(result.error, arguments, asked);
  if (result && needsInside(arguments)) findInside(arguments, mesh, result.mesh);
  return result;
}

void findInside(const Arguments& arguments, const Mesh& mesh, CutMesh& cutMesh) {
  if (arguments.refines()) return;  // estimates divide regions
  cutMesh = withProgress(arguments.threads, [&](const RunOptions& options) {
    return estimateInside(mesh, cutMesh, {options, arguments.insideThreshold.value_or(kThreshold)});
  });
}

Report reportOf(const Arguments& arguments, MeshReport mesh, const AskedGrid& grid, const CutResult& result) {
  return {std::move(mesh),       grid, result, peakMemoryBytes(), {}, {}, arguments.insideThreshold.value_or(kThreshold), {},
          countsOf(result.mesh), {}};
}

std::optional<CutResult> cutOrComplain(const Arguments& arguments, const Input& input, const GridArguments& asked) {
  const MeshReport mesh{input, inspect(input.mesh), {}};
  const AskedGrid grid = makeGrid(asked, input.mesh);
  CutResult result = cutMesh(arguments, input.mesh, grid);
  if (result) return result;
  failWith(arguments, input.name, result.error, [&] { return reportJson(reportOf(arguments, mesh, grid, result)); });
  return std::nullopt;
}

std::optional<InsideRegions> insideOf(const Arguments& arguments, const CutMesh& cutMesh) {
  return insideOf(cutMesh, arguments.insideThreshold.value_or(kThreshold));
}

static RefinedCells refine(const Arguments& arguments, const Input& input, const CutMesh& cutMesh, const CoarsenOptions& coarsening) {
  const PrepareResult prepared = prepare(input.mesh, {{coarsening.threads, coarsening.progress}, arguments.intersections});
  if (!prepared) throw CallError(prepared.error);
  RefineOptions options;
  static_cast<RunOptions&>(options) = coarsening;
  options.levels = arguments.refine;
  options.angle = arguments.refineAngle;
  options.boxes = arguments.refineBoxes;
  options.coarsening = coarsening;
  return refineCells(prepared.mesh, cutMesh, options);
}

MadeCells makeCells(const Arguments& arguments, const Input& input, const CutMesh& whole) {
  return withProgress(arguments.threads, [&](const RunOptions& run) {
    const CoarsenOptions coarsening = coarsenOptions(arguments, run);
    MadeCells made;
    if (arguments.refines()) {
      RefinedCells refined = refine(arguments, input, whole, coarsening);
      made.cells = std::move(refined.cells);
      made.refined = std::move(refined.cutMesh);
    } else {
      made.cells = cellComplex(input.mesh, whole, coarsen(whole, coarsening), run);
    }
    const CutMesh& cutMesh = made.cutMesh(whole);
    const double fraction = mergeFraction(arguments);
    if (fraction > 0) static_cast<MergedCells&>(made) = mergeSmallCells(cutMesh, made.cells, MergeOptions{run, fraction});
    if (arguments.uniteWalls) made.cells = uniteWalls(cutMesh, made.cells, {run, *arguments.uniteWalls, input.groups.triangleGroup});
    return made;
  });
}

CoarsenOptions coarsenOptions(const Arguments& arguments, const RunOptions& run) {
  CoarsenOptions options{run};
  options.maxLevel = arguments.coarsen.value_or(0);
  if (arguments.coarsenLayers) options.fineLayers = options.layersPerLevel = *arguments.coarsenLayers;
  return options;
}

double mergeFraction(const Arguments& arguments) {
  return arguments.merge.value_or(arguments.command == Command::flow ? MergeOptions().fraction : 0);
}

WriteOptions writeOptions(const Arguments& arguments, const CutResult& cut) {
  const CutMesh& cutMesh = cut.mesh;
  OnlyArguments only = arguments.only;
  std::optional<InsideRegions> inside;
  if (only.inside || only.outside || isInsideDefault(arguments)) inside = insideOf(arguments, cutMesh);
  const bool any = isAnyInside(inside);
  const std::string how = inside ? describeInside(inside, cut.stats.parts) : "";
  if (only.inside && !any) throw UsageError("--only inside: nothing is inside" + (how.empty() ? how : " (" + how + ")"));
  if (!how.empty()) std::cerr << "Note: " << how << "\n";
  if (isInsideDefault(arguments)) only.inside = any;
  WriteOptions options;
  options.untouched = !only.cut;
  options.simpleCells = arguments.simpleCells;
  if (!only.inside && !only.outside && !only.all && only.regions.empty()) return options;
  options.regions.assign(cutMesh.regionCount, only.regions.empty() ? 1 : 0);
  for (const uint32_t r : only.regions) {
    if (r >= cutMesh.regionCount) {
      throw UsageError("--only: there is no region " + std::to_string(r) + "; there are " + std::to_string(cutMesh.regionCount));
    }
    options.regions[r] = 1;
  }
  for (uint32_t r = 0; r < cutMesh.regionCount; ++r) {
    const bool isInside = inside && inside->isInside[r];
    if ((only.inside && !isInside) || (only.outside && isInside)) options.regions[r] = 0;
  }
  return options;
}

void requireSelection(const WriteOptions& options, const CutMesh& cutMesh) {
  const auto isSelected = [&](uint32_t region) { return options.hasRegion(region); };
  const std::vector<uint32_t>& regions = cutMesh.cellRegion;
  if (std::any_of(regions.begin(), regions.end(), isSelected)) return;
  const bool hasRegion =
      options.regions.empty() || std::any_of(options.regions.begin(), options.regions.end(), [](uint8_t r) { return r != 0; });
  if (hasRegion && options.untouched) return;
  throw UsageError("--only selects nothing of the " + std::to_string(cutMesh.regionCount) + " regions and " +
                   std::to_string(cutMesh.cellCount()) + " cut-cells");
}

FileFormat formatFor(const Arguments& arguments, const std::string& output) {
  return output == "-" ? *arguments.format : *formatOf(output);
}

std::string refusal(const std::string& meshName, const Outcome& outcome) {
  return meshName + ": " + outcome.status + ": " + outcome.message;
}

}  // namespace mandoline::cli
