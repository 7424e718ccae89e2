#include "cli/cut_command.h"

#include <iostream>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "io/poly_mesh.h"
#include "mandoline/measure.h"

namespace mandoline::cli {
namespace {

/// A file, and which part of the cut-mesh is written to it.
struct Output {
  std::string path;
  WriteOptions options;
};

/// Names with {region} stand for one file per region.
std::vector<Output> outputsOf(const Arguments& arguments, const CutResult& cut) {
  const CutMesh& cutMesh = cut.mesh;
  const WriteOptions options = writeOptions(arguments, cut);
  if (arguments.only.any()) requireSelection(options, cutMesh);
  std::vector<Output> outputs;
  for (const std::string& output : arguments.outputs) {
    const size_t mark = output.find(kRegionMark);
    if (mark == std::string::npos) {
      outputs.push_back({output, options});
      continue;
    }
    for (uint32_t r = 0; r < cutMesh.regionCount; ++r) {
      if (!options.regions.empty() && !options.regions[r]) continue;
      outputs.push_back({output, options});
      outputs.back().path.replace(mark, kRegionMark.size(), std::to_string(r));
      outputs.back().options.regions.assign(cutMesh.regionCount, 0);
      outputs.back().options.regions[r] = 1;
    }
  }
  std::vector<NamedFile> files;
  for (const Output& output : outputs) files.push_back({"-o", output.path});
  requireDifferent(files);
  return outputs;
}

/// Writes a cut-mesh, and its cell complex for those outputs that take one.
class Writer {
 public:
  Writer(const Arguments& arguments, const Input& input, const CutMesh& cutMesh)
      : arguments_(arguments), input_(input), cutMesh_(cutMesh) {}

  /// Makes the cells unless they are there.
  const MadeCells& cells() {
    if (!cells_) cells_ = makeCells(arguments_, input_, cutMesh_);
    return *cells_;
  }

  void write(const Output& output) {
    const bool isFolder = isPolyMesh(output.path);
    const std::optional<FileFormat> format = isFolder ? std::nullopt : std::optional(formatFor(arguments_, output.path));
    const bool isVtu = format == FileFormat::vtu, isJson = format == FileFormat::json;
    const bool ofComplex = isFolder || (needsComplex(arguments_) && (isVtu || isJson)) || (arguments_.faces && isVtu);
    const CellComplex* const complex = ofComplex ? &cells().cells : nullptr;
    const CutMesh& cutMesh = ofComplex ? cells().cutMesh(cutMesh_) : cutMesh_;
    withProgress(arguments_.threads, [&](const RunOptions& run) {
      WriteOptions options = output.options;
      static_cast<RunOptions&>(options) = run;
      options.groups = &input_.groups;
      if (isFolder) {
        const DeferInterrupts defer;
        writePolyMesh(output.path, cutMesh, *complex, options);
        if (detail::isMerged(*complex) && options.regions.empty())
          noteLeftOut(output.path, detail::regionsAtSides(cutMesh.regionCount, *complex));
        return;
      }
      writeOutput(output.path, [&](const Sink& sink) {
        if (!ofComplex) return writeCutMesh(sink, *format, input_.mesh, cutMesh, options);
        if (isJson) return writeJson(sink, cutMesh, *complex, options);
        if (arguments_.faces) return writeFacesVtu(sink, cutMesh, *complex, {}, options);
        writeVtu(sink, cutMesh, *complex, {}, options);
      });
    });
  }

 private:
  const Arguments& arguments_;
  const Input& input_;
  const CutMesh& cutMesh_;
  std::optional<MadeCells> cells_;
};

void complainOf(const Report& report, int& exitCode) {
  if (!report.result) {
    complain(refusal(report.mesh.input.name, report.result.error));
    exitCode = kNotCut;
  }
  if (!report.validation || report.validation->pass) return;
  for (const Check& check : report.validation->checks) {
    if (!check.pass) complain(report.mesh.input.name + ": validation failed: " + describeFailure(check));
  }
  exitCode = kNotCut;
}

}  // namespace

bool needsComplex(const Arguments& arguments) {
  return arguments.coarsen || arguments.merge || arguments.uniteWalls || arguments.refines();
}

void noteLeftOut(const std::string& path, const std::vector<uint8_t>& atSides) {
  const size_t leftOut = detail::countLeftOut(atSides);
  if (leftOut == 0) return;
  std::cerr << "Note: " << path << " is without " << leftOut << " of " << atSides.size()
            << " regions: no side of the grid bounds them, and OpenFOAM's solvers stop where nothing holds the pressure. --only all writes "
               "these, too\n";
}

void checkCutOutputs(const Arguments& arguments) {
  std::vector<NamedFile> files = filesBesideOutputs(arguments);
  bool hasCells = false, hasVtu = false, hasFolder = false;
  for (const std::string& output : arguments.outputs) {
    if (isPolyMesh(output)) {
      hasCells = hasFolder = true;
      files.push_back({"-o", output});
      continue;
    }
    if (output != "-") checkOutput(output);
    const FileFormat format = formatFor(arguments, output);
    if (!isCutMeshFormat(format)) throw UsageError(std::string("--format needs json, mcm, vtu, obj, stl or ply, not ") + name(format));
    const bool hasAll = format == FileFormat::json || format == FileFormat::mcm;
    if (hasAll && (arguments.only.any() || output.find(kRegionMark) != std::string::npos)) {
      throw UsageError("-o " + output + ": ." + name(format) + " files always have everything");
    }
    hasVtu |= format == FileFormat::vtu;
    hasCells |= format == FileFormat::vtu || format == FileFormat::json;
    files.push_back({"-o", output});
  }
  if (arguments.coarsen && !hasCells)
    throw UsageError("--coarsen: only .vtu and .json files and polyMesh folders have cells away from the surface");
  for (const auto& [isGiven, option] : {std::pair(arguments.merge.has_value(), "--merge"),
                                        {arguments.refines(), arguments.refineOption()},
                                        {arguments.uniteWalls.has_value(), "--unite-walls"}}) {
    if (isGiven && !hasCells) throw UsageError(std::string(option) + ": only .vtu and .json files and polyMesh folders have all cells");
  }
  if (arguments.faces && !hasVtu) throw UsageError("--faces: only .vtu files have faces instead of cells");
  if (arguments.simpleCells && !hasVtu && !hasFolder)
    throw UsageError("--simple-cells: only .vtu files and polyMesh folders can do without faces inside cells");
  requireDifferent(files);
}

int finishCut(const CutJob& job, const CutResult& result, const std::vector<RankReport>& ranks) {
  const Arguments& arguments = job.arguments;
  const Input& input = job.input;
  Report report = reportOf(arguments, {input, job.info, {}}, job.grid, result);
  report.ranks = ranks;
  Writer writer(arguments, input, result.mesh);
  if (result) {
    report.regionVolumes = withProgress(arguments.threads, [&](const RunOptions& options) {
      return regionVolumes(result.mesh, measure(input.mesh, result.mesh, options));
    });
    if (arguments.validate) {
      report.validation =
          withProgress(arguments.threads, [&](const RunOptions& options) { return validate(input.mesh, result.mesh, options); });
    }
    if (mergeFraction(arguments) > 0) report.merge = countMerged(writer.cells());
  }
  int exitCode = kFine;
  complainOf(report, exitCode);
  attempt(exitCode, [&] {
    deliver(
        arguments, [&] { return reportText(report); }, [&] { return reportJson(report); });
  });
  if (!result) return exitCode;
  attempt(exitCode, [&] {
    for (const Output& output : outputsOf(arguments, result)) attempt(exitCode, [&] { writer.write(output); });
  });
  return exitCode;
}

int runCut(const Arguments& arguments) {
  checkCutOutputs(arguments);
  const Input input = readInput(arguments);
  const MeshInfo info = inspect(input.mesh);
  const AskedGrid grid = makeGrid(arguments.grid, input.mesh);
  return finishCut({arguments, input, info, grid}, cutMesh(arguments, input.mesh, grid));
}

}  // namespace mandoline::cli
