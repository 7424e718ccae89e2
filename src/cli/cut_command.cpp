#include <algorithm>
#include <iostream>

#include "cli/commands.h"
#include "cli/files.h"
#include "cli/make_grid.h"
#include "cli/peak_memory.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "mandoline/measure.h"

namespace mandoline::cli {
namespace {

constexpr std::string_view kRegionMark = "{region}";

FileFormat formatFor(const Arguments& arguments, const std::string& output) {
  return output == "-" ? *arguments.format : *formatOf(output);
}

/// What can be told before there is a mesh.
void checkOutputs(const Arguments& arguments) {
  std::vector<NamedFile> files;
  if (arguments.mesh != "-") files.push_back({"the mesh", arguments.mesh});
  if (!arguments.report.empty()) files.push_back({"--report", arguments.report});
  for (const std::string& output : arguments.outputs) {
    if (output != "-") checkOutput(output);
    const FileFormat format = formatFor(arguments, output);
    if (format == FileFormat::off) throw UsageError("--format needs json, vtu, obj, stl or ply, not off");
    if (format == FileFormat::json && (arguments.only.any() || output.find(kRegionMark) != std::string::npos)) {
      throw UsageError("-o " + output + ": JSON files always have everything");
    }
    files.push_back({"-o", output});
  }
  requireDifferent(files);
}

CutResult cutWithProgress(const Arguments& arguments, const Mesh& mesh, const Grid& grid) {
  ProgressBar bar;
  CutOptions options;
  options.snapTolerance = arguments.snapTolerance;
  options.threads = arguments.threads;
  options.progress = [&](const Progress& progress) { return bar.update(progress); };
  CutResult result = cut(mesh, grid, options);
  throwIfInterrupted();
  return result;
}

/// Throws UsageError for regions that the cut-mesh does not have.
WriteOptions writeOptions(const OnlyArguments& only, const CutMesh& cutMesh) {
  WriteOptions options;
  options.untouchedCells = !only.cut;
  if ((only.inside || only.outside) && !cutMesh.hasWinding) {
    throw UsageError("--only: the mesh is open or not consistently oriented, so that nothing is inside or outside");
  }
  if (!only.inside && !only.outside && only.regions.empty()) return options;
  options.regions.assign(cutMesh.regionCount, only.regions.empty() ? 1 : 0);
  for (const uint32_t r : only.regions) {
    if (r >= cutMesh.regionCount) {
      throw UsageError("--only: there is no region " + std::to_string(r) + "; there are " + std::to_string(cutMesh.regionCount));
    }
    options.regions[r] = 1;
  }
  for (uint32_t r = 0; r < cutMesh.regionCount; ++r) {
    const bool isInside = cutMesh.hasWinding && cutMesh.regionWinding[r] != 0;
    if ((only.inside && !isInside) || (only.outside && isInside)) options.regions[r] = 0;
  }
  return options;
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
    complain(report.mesh.name + ": " + name(report.result.error.status) + ": " + report.result.error.message);
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
  const CutResult result = cutWithProgress(arguments, mesh, grid);
  Report report{{nameOf(arguments.mesh), info}, grid, result, peakMemoryBytes(), {}, {}};
  if (result) {
    report.regionVolumes = regionVolumes(result.mesh, measure(mesh, result.mesh, {arguments.threads, nullptr}));
    if (arguments.validate) report.validation = validate(mesh, result.mesh, {{arguments.threads, nullptr}, arguments.snapTolerance});
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
