#include "cli/flow_steps.h"

#ifdef MANDOLINE_HAVE_OPERATORS

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/commands.h"
#include "cli/files.h"
#include "mandoline/unsteady.h"
#include "operators/measure/vector.h"

namespace mandoline::cli {
namespace {

/// What there is to tell of the steps.
struct StepsReport {
  const MeshReport& mesh;
  const SteppedCells& stepped;
  std::array<double, 3> wind;
  std::optional<MergeCounts> merge;
  FlowStep last;  ///< but iterations, and the largest divergence, are those of all
  size_t steps = 0;
  double time = 0, largestSpeed = 0;
  std::vector<std::string> groups;
  std::vector<SurfaceForce> forces;  ///< per group, or of all

  Outcome outcome() const {
    if (last.status == SolveStatus::converged) return {};
    return {name(last.status), std::string("A step was not solved: ") + name(last.status) + "."};
  }

  std::string text() const {
    char text[400];
    std::snprintf(text, sizeof text,
                  "cells                 %zu\nstatus                %s\nsteps                 %zu\ntime                  %.6g\n"
                  "iterations            %zu\nlargest divergence    %.2g\nlargest speed         %.6g\n",
                  stepped.merged.cells.cellCount(), name(last.status), steps, time, last.iterations, last.divergence, largestSpeed);
    std::string result = headline(mesh) + text;
    for (size_t g = 0; g < forces.size(); ++g) {
      const auto& [pressure, viscous, moment] = forces[g];
      result += "force" + (groups.empty() ? std::string() : " on " + groups[g]) + ": of pressure " + triple(pressure.data(), " ") +
                ", viscous " + triple(viscous.data(), " ") + "\n";
    }
    return result;
  }

  std::string json() const {
    Json json;
    addHead(json, outcome(), mesh);
    const CellComplex& cells = stepped.merged.cells;
    json.key("wind").values(wind).member("cutCells", cells.cutCells).member("cells", cells.cellCount());
    addMerge(json, merge);
    json.member("faces", cells.faceCount()).member("steps", steps).member("time", time).member("timeStep", last.timeStep);
    json.member("iterations", last.iterations).member("largestDivergence", last.divergence).member("largestSpeed", largestSpeed);
    json.key("forces").open('[');
    for (size_t g = 0; g < forces.size(); ++g) {
      json.open('{').member("group", groups.empty() ? std::nullopt : std::optional(groups[g]));
      json.key("pressure").values(forces[g].pressure).key("viscous").values(forces[g].viscous).key("moment").values(forces[g].moment);
      json.close('}');
    }
    return json.close(']').close('}').text();
  }
};

/// Until one fails.
void takeSteps(const Arguments& arguments, FlowStepper& stepper, StepsReport& report) {
  const uint32_t steps = *arguments.flow.steps;
  withProgress(arguments.threads, [&](const RunOptions& run) {
    while (report.steps < steps && report.last.status == SolveStatus::converged && run.progress({"steps", 0, 1, report.steps, steps})) {
      const FlowStep before = report.last;
      report.last = stepper.step();
      report.last.iterations += before.iterations;
      report.last.divergence = std::max(report.last.divergence, before.divergence);
      if (report.last.status == SolveStatus::converged) ++report.steps;
    }
  });
}

}  // namespace

void writeFlowVtu(const Arguments& arguments, const std::string& output, const FlowFields& fields, WriteOptions options) {
  withProgress(arguments.threads, [&](const RunOptions& run) {
    static_cast<RunOptions&>(options) = run;
    const CellComplex& cells = fields.cells;
    const Field ofFaces[] = {{"normal_velocity", fields.faceVelocity}, {"normal", cells.faceNormal}, {"area", cells.faceArea}};
    writeOutput(output, [&](const Sink& sink) {
      arguments.faces ? writeFacesVtu(sink, fields.cutMesh, cells, ofFaces, options)
                      : writeVtu(sink, fields.cutMesh, cells, fields.ofCells, options);
    });
  });
}

double largestSpeed(const std::vector<double>& cellVelocity) {
  double largest = 0;
  for (size_t i = 0; i < cellVelocity.size(); i += 3) {
    const double speed = measuring::length({cellVelocity[i], cellVelocity[i + 1], cellVelocity[i + 2]});
    if (std::isnan(speed)) return speed;
    largest = std::max(largest, speed);
  }
  return largest;
}

int runSteps(const Arguments& arguments, const SteppedCells& stepped, const WriteOptions& options) {
  const CellComplex& cells = stepped.merged.cells;
  FlowStepperOptions flowOptions;
  flowOptions.threads = arguments.threads;
  flowOptions.viscosity = arguments.flow.viscosity;
  FlowStepper stepper(cells, *arguments.flow.wind, flowOptions);
  const MeshReport meshReport{stepped.input, inspect(stepped.input.mesh), {}};
  StepsReport report{meshReport, stepped, *arguments.flow.wind, {}, {}, 0, 0, 0, stepped.input.groups.names, {}};
  takeSteps(arguments, stepper, report);
  const UnsteadyFlow& flow = stepper.flow();
  report.time = flow.time, report.largestSpeed = largestSpeed(flow.cellVelocity);
  if (mergeFraction(arguments) > 0) report.merge = countMerged(stepped.merged);
  std::vector<uint32_t> groups;
  if (!report.groups.empty()) groups = faceGroups(stepped.cutMesh, cells, stepped.input.groups.triangleGroup);
  report.forces = stepper.forces(groups);
  report.forces.resize(std::max<size_t>(1, report.groups.size()));
  int exitCode = kFine;
  if (report.last.status != SolveStatus::converged) {
    complain(stepped.input.name + ": step " + std::to_string(report.steps + 1) + " was not solved: " + name(report.last.status));
    exitCode = kNotCut;
  }
  attempt(exitCode, [&] {
    deliver(
        arguments, [&] { return report.text(); }, [&] { return report.json(); });
  });
  const Field ofCells[] = {{"velocity", flow.cellVelocity}, {"pressure", flow.cellPressure}};
  const auto write = [&](const std::string& output) {
    writeFlowVtu(arguments, output, {stepped.cutMesh, cells, ofCells, flow.faceVelocity}, options);
  };
  return writeOutputs(arguments, write, exitCode);
}

}  // namespace mandoline::cli

#endif
