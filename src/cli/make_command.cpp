#include "cli/commands.h"
#include "cli/files.h"
#include "mandoline/shapes.h"

namespace mandoline::cli {
namespace {

Mesh makeShape(const std::string& shape) {
  if (shape == "box") return makeBox({-1, -1, -1}, {1, 1, 1});
  if (shape == "sphere") return makeSphere({0, 0, 0}, 1, 4);
  if (shape == "torus") return makeTorus(1, 0.4, 96, 48);
  if (shape == "torus-knot") return makeTorusKnot();
  throw UsageError("there are the shapes box, sphere, torus and torus-knot, not '" + shape + "'");
}

}  // namespace

int runMake(const Arguments& arguments) {
  std::vector<NamedFile> files;
  for (const std::string& output : arguments.outputs) {
    files.push_back({"-o", output});
    const std::optional<FileFormat> format = output == "-" ? arguments.format : formatOf(output);
    if (!format || !isMeshFormat(*format)) {
      throw UsageError(output + ": a mesh is written as .obj, .stl, .ply or .off");
    }
  }
  requireDifferent(files);
  const Mesh mesh = makeShape(arguments.shape);
  for (const std::string& output : arguments.outputs) {
    writeOutput(output, [&](const Sink& sink) { writeMesh(sink, output == "-" ? *arguments.format : *formatOf(output), mesh); });
  }
  return kFine;
}

}  // namespace mandoline::cli
