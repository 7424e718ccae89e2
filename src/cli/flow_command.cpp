#include "cli/commands.h"

#ifdef MANDOLINE_HAVE_OPERATORS

#include <algorithm>
#include <cstdio>

#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/flow_command.h"
#include "cli/flow_steps.h"
#include "cli/mesh_report.h"

namespace mandoline::cli {
namespace {

bool isFlowFormat(FileFormat format) { return format == FileFormat::vtu || format == FileFormat::obj; }
bool isStepsFormat(FileFormat format) { return format == FileFormat::vtu; }

/// What there is to tell of a flow.
struct FlowReport {
  const MeshReport& mesh;
  const FlowField& field;
  std::optional<MergeCounts> merge;
  const std::vector<RankReport>& ranks;

  Outcome outcome() const {
    const SolveStatus status = flow().status;
    if (status == SolveStatus::converged) return {};
    return {name(status), std::string("The flow was not solved: ") + name(status) + "."};
  }

  size_t iterations() const { return flow().residuals.empty() ? 0 : flow().residuals.size() - 1; }
  double residual() const { return flow().residuals.empty() ? 0 : flow().residuals.back(); }
  double largestSpeed() const { return cli::largestSpeed(flow().cellVelocity); }

  std::string text() const {
    char text[400];
    std::snprintf(text, sizeof text,
                  "cells                 %zu\nstatus                %s\niterations            %zu\nresidual              %.2g\n"
                  "largest speed         %.6g\nthrottled components  %zu\n",
                  field.cells.cellCount(), name(flow().status), iterations(), residual(), largestSpeed(), flow().throttled.size());
    return headline(mesh) + text + ranksText(ranks);
  }

  std::string json() const {
    Json json;
    addHead(json, outcome(), mesh);
    json.key("wind").values(flow().wind).member("cutCells", field.cells.cutCells).member("cells", field.cells.cellCount());
    addMerge(json, merge);
    json.member("faces", field.cells.faceCount()).member("iterations", iterations()).key("residuals").values(flow().residuals);
    json.member("largestSpeed", largestSpeed()).key("throttled").values(flow().throttled);
    if (!ranks.empty()) addRanks(json, ranks);
    return json.close('}').text();
  }

 private:
  const Flow& flow() const { return field.flow; }
};

bool isVtu(const Arguments& arguments, const std::string& output) { return formatFor(arguments, output) == FileFormat::vtu; }

constexpr uint32_t kStreamlines = 100;

void write(const Arguments& arguments, const std::string& output, const FlowField& field, const WriteOptions& options) {
  if (isVtu(arguments, output)) {
    const Flow& flow = field.flow;
    const Field ofCells[] = {{"phi", flow.phi}, {"velocity", flow.cellVelocity}, {"pressure_coefficient", flow.cellPressure}};
    return writeFlowVtu(arguments, output, {field.cutMesh, field.cells, ofCells, flow.faceVelocity}, options);
  }
  withProgress(arguments.threads, [&](const RunOptions& run) {
    const std::vector<double> seeds =
        inflowSeeds(field.cutMesh.grid, *arguments.flow.wind, arguments.flow.streamlines.value_or(kStreamlines));
    const Streamlines lines = streamlines(field, seeds, StreamlineOptions{run});
    writeOutput(output, [&](const Sink& sink) { writeLines(sink, lines.points, lines.offsets, run); });
  });
}

}  // namespace

void checkFlowOutputs(const Arguments& arguments) {
  if (arguments.flow.steps) return checkOutputs(arguments, isStepsFormat, "a flow in steps is written as .vtu");
  checkOutputs(arguments, isFlowFormat, "a flow is written as .vtu or .obj");
  const auto writesVtu = [&](const std::string& output) { return isVtu(arguments, output); };
  const bool hasLines = !std::all_of(arguments.outputs.begin(), arguments.outputs.end(), writesVtu);
  if (arguments.flow.streamlines && !hasLines) throw UsageError("--streamlines: only .obj files have streamlines");
  if (std::any_of(arguments.outputs.begin(), arguments.outputs.end(), writesVtu)) return;
  if (arguments.faces) throw UsageError("--faces: only .vtu files have faces instead of cells");
  if (arguments.simpleCells) throw UsageError("--simple-cells: only .vtu files have cells");
  if (arguments.only.any()) throw UsageError("--only: only .vtu files have a part of the cells");
}

int finishFlow(const FlowJob& job, const SolveCells& solve, const std::vector<RankReport>& ranks) {
  const Arguments& arguments = job.arguments;
  const Input& input = job.input;
  WriteOptions options = writeOptions(arguments, job.cut);
  if (arguments.only.any()) requireSelection(options, job.cut.mesh);
  options.groups = &input.groups;
  const MadeCells merged = makeCells(arguments, input, job.cut.mesh);
  if (arguments.flow.steps) return runSteps(arguments, {input, merged.cutMesh(job.cut.mesh), merged}, options);
  const Flow flow = withProgress(arguments.threads, [&](const RunOptions& run) { return solve(merged.cells, run); });
  const FlowField field{input.mesh, merged.cutMesh(job.cut.mesh), merged.cells, flow};
  int exitCode = kFine;
  if (flow.status != SolveStatus::converged) {
    complain(input.name + ": the flow was not solved: " + name(flow.status));
    exitCode = kNotCut;
  }
  const MeshReport meshReport{input, inspect(input.mesh), {}};
  FlowReport report{meshReport, field, {}, ranks};
  if (mergeFraction(arguments) > 0) report.merge = countMerged(merged);
  attempt(exitCode, [&] {
    deliver(
        arguments, [&] { return report.text(); }, [&] { return report.json(); });
  });
  return writeOutputs(
      arguments, [&](const std::string& output) { write(arguments, output, field, options); }, exitCode);
}

int runFlow(const Arguments& arguments) {
  checkFlowOutputs(arguments);
  const Input input = readInput(arguments);
  const std::optional<CutResult> cut = cutOrComplain(arguments, input, flowGrid(arguments.grid));
  if (!cut) return kNotCut;
  return finishFlow({arguments, input, *cut}, [&](const CellComplex& cells, const RunOptions& run) {
    FlowOptions options{run};
    options.farField = arguments.flow.farField;
    options.corrections = arguments.flow.corrections.value_or(options.corrections);
    return solveFlow(cells, *arguments.flow.wind, options);
  });
}

}  // namespace mandoline::cli

#else

namespace mandoline::cli {

int runFlow(const Arguments&) {
  complain("this program was built without Eigen, which flow needs");
  return kBadUsageOrFile;
}

}  // namespace mandoline::cli

#endif
