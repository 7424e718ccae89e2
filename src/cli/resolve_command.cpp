#include <iostream>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/report.h"
#include "mandoline/resolve.h"

namespace mandoline::cli {
int runResolve(const Arguments& arguments) {
  std::vector<NamedFile> files{{"the mesh", arguments.mesh}};
  for (const std::string& output : arguments.outputs) {
    files.push_back({"-o", output});
    const std::optional<FileFormat> format = output == "-" ? arguments.format : formatOf(output);
    if (!format || !isMeshFormat(*format)) throw UsageError(output + ": a mesh is written as .obj, .stl, .ply or .off");
  }
  requireDifferent(files);
  const Mesh mesh = readInput(arguments.mesh);
  const ResolveResult result = withProgress(arguments.threads, [&](const RunOptions& options) { return resolve(mesh, options); });
  if (!result) {
    complain(refusal(nameOf(arguments.mesh), result.error));
    return kNotCut;
  }
  if (arguments.rule && !result.mesh.hasWinding) {
    complain(nameOf(arguments.mesh) + ": the mesh is open or not consistently oriented, so that it bounds no solid");
    return kNotCut;
  }
  const Mesh written = arguments.rule ? boundary(result.mesh, *arguments.rule) : result.mesh.mesh;
  for (const std::string& output : arguments.outputs) {
    writeOutput(output, [&](const Sink& sink) { writeMesh(sink, output == "-" ? *arguments.format : *formatOf(output), written); });
  }
  const PairCounts &met = result.stats.intersections, &left = result.remaining;
  std::cerr << "Pairs of triangles that met: " << describePairs(met) << "\n"
            << "After the rounding of vertices: " << describePairs(left) << "\n"
            << "Triangles written: " << written.triangleCount() << "\n";
  return kFine;
}

}  // namespace mandoline::cli
