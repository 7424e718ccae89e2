#include <algorithm>
#include <iostream>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/make_grid.h"
#include "cli/peak_memory.h"
#include "cli/report.h"
#include "mandoline/measure.h"

namespace mandoline::cli {
namespace {

constexpr std::string_view kRegionMark = "{region}";

/// What can be told before there is a mesh.
void checkOutputs(const Arguments& arguments) {
  std::vector<NamedFile> files;
  if (arguments.mesh != "-") files.push_back({"the mesh", arguments.mesh});
  if (!arguments.report.empty()) files.push_back({"--report", arguments.report});
  for (const std::string& output : arguments.outputs) {
    if (output != "-") checkOutput(output);
    const FileFormat format = formatFor(arguments, output);
    if (!isCutMeshFormat(format)) throw UsageError(std::string("--format needs json, vtu, obj, stl or ply, not ") + name(format));
    if (format == FileFormat::json && (arguments.only.any() || output.find(kRegionMark) != std::string::npos)) {
      throw UsageError("-o " + output + ": JSON files always have everything");
    }
    files.push_back({"-o", output});
  }
  requireDifferent(files);
}

/// A file to write and what it gets.
struct Output {
  std::string path;
  WriteOptions options;
};

/// Names with {region} stand for one file per region.
std::vector<Output> outputsOf(const Arguments& arguments, const CutMesh& cutMesh) {
  const WriteOptions options = writeOptions(arguments.only, cutMesh);
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

/// Every report and cut-mesh gets its chance, even if another can't be written.
template <class Work>
void attempt(int& exitCode, const Work& work) {
  try {
    work();
  } catch (const FileError& error) {
    complain(error.what());
    exitCode = kBadUsageOrFile;
  } catch (const UsageError& error) {
    complain(error.what());
    exitCode = kBadUsageOrFile;
  }
}

void deliver(const Arguments& arguments, const Report& report) {
  const bool outputTaken = std::find(arguments.outputs.begin(), arguments.outputs.end(), "-") != arguments.outputs.end();
  if (!arguments.report.empty()) {
    writeOutput(arguments.report, [&](const Sink& sink) { sink(reportJson(report)); });
  } else if (outputTaken) {
    std::cerr << reportText(report);
  } else {
    writeOutput("-", [&](const Sink& sink) { sink(reportText(report)); });
  }
}

void complainOf(const Report& report, int& exitCode) {
  if (!report.result) {
    complain(refusal(report.mesh.name, report.result.error));
    exitCode = kNotCut;
  }
  if (!report.validation || report.validation->pass) return;
  for (const Check& check : report.validation->checks) {
    if (!check.pass) complain(report.mesh.name + ": validation failed: " + describeFailure(check));
  }
  exitCode = kNotCut;
}

}  // namespace

int runCut(const Arguments& arguments) {
  checkOutputs(arguments);
  const Mesh mesh = readInput(arguments.mesh);
  const MeshInfo info = inspect(mesh);
  const Grid grid = makeGrid(arguments.grid, mesh, info);
  const CutResult result = cutMesh(arguments, mesh, grid);
  Report report{{nameOf(arguments.mesh), info}, grid, result, peakMemoryBytes(), {}, {}};
  if (result) {
    report.regionVolumes = withProgress(
        arguments.threads, [&](const RunOptions& options) { return regionVolumes(result.mesh, measure(mesh, result.mesh, options)); });
    if (arguments.validate) {
      report.validation = withProgress(arguments.threads, [&](const RunOptions& options) {
        return validate(mesh, result.mesh, {options, arguments.snapTolerance});
      });
    }
  }
  int exitCode = kFine;
  complainOf(report, exitCode);
  attempt(exitCode, [&] { deliver(arguments, report); });
  if (!result) return exitCode;
  attempt(exitCode, [&] {
    for (const Output& output : outputsOf(arguments, result.mesh)) {
      attempt(exitCode, [&] {
        writeOutput(output.path,
                    [&](const Sink& sink) { writeCutMesh(sink, formatFor(arguments, output.path), mesh, result.mesh, output.options); });
      });
    }
  });
  return exitCode;
}

}  // namespace mandoline::cli
