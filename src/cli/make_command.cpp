#include "cli/commands.h"
#include "cli/cutting.h"
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
  checkOutputs(arguments, isMeshFormat, "a mesh is written as .obj, .stl, .ply or .off");
  const Mesh mesh = makeShape(arguments.shape);
  return writeOutputs(arguments, [&](const std::string& output) {
    writeOutput(output, [&](const Sink& sink) { writeMesh(sink, formatFor(arguments, output), mesh); });
  });
}

}  // namespace mandoline::cli
