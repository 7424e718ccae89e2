#include "cli/cutting.h"

#include <algorithm>

#include "cli/commands.h"
#include "cli/files.h"
#include "cli/make_grid.h"

namespace mandoline::cli {

void checkOutputs(const Arguments& arguments, bool (*isAllowed)(FileFormat), const std::string& rule) {
  std::vector<NamedFile> files;
  if (!arguments.mesh.empty() && arguments.mesh != "-") files.push_back({"the mesh", arguments.mesh});
  if (!arguments.report.empty()) files.push_back({"--report", arguments.report});
  for (const std::string& output : arguments.outputs) {
    const std::optional<FileFormat> format = output == "-" ? arguments.format : formatOf(output);
    if (!format || !isAllowed(*format)) throw UsageError(output + ": " + rule);
    files.push_back({"-o", output});
  }
  requireDifferent(files);
}

bool takesStandardOutput(const Arguments& arguments) {
  return std::find(arguments.outputs.begin(), arguments.outputs.end(), "-") != arguments.outputs.end();
}

CutResult cutMesh(const Arguments& arguments, const Mesh& mesh, const Grid& grid) {
  return withProgress(arguments.threads, [&](const RunOptions& options) {
    return cut(mesh, grid, {options, arguments.snapTolerance, arguments.intersections});
  });
}

std::optional<CutMesh> cutOrComplain(const Arguments& arguments, const Mesh& mesh, const GridArguments& grid) {
  CutResult result = cutMesh(arguments, mesh, makeGrid(grid, mesh, inspect(mesh)));
  if (result) return std::move(result.mesh);
  complain(refusal(nameOf(arguments.mesh), result.error));
  return std::nullopt;
}

CellComplex makeCells(const Arguments& arguments, const Mesh& mesh, const CutMesh& cutMesh) {
  return withProgress(arguments.threads, [&](const RunOptions& run) {
    CoarsenOptions coarsening{run};
    coarsening.maxLevel = arguments.coarsen.value_or(0);
    return cellComplex(mesh, cutMesh, coarsen(cutMesh, coarsening), run);
  });
}

WriteOptions writeOptions(const OnlyArguments& only, const CutMesh& cutMesh) {
  WriteOptions options;
  options.untouched = !only.cut;
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

FileFormat formatFor(const Arguments& arguments, const std::string& output) {
  return output == "-" ? *arguments.format : *formatOf(output);
}

std::string refusal(const std::string& meshName, const Error& error) { return meshName + ": " + name(error.status) + ": " + error.message; }

}  // namespace mandoline::cli
