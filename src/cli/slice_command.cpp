#include <algorithm>
#include <cmath>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"

namespace mandoline::cli {
namespace {

/// The heights that were asked for, or those in the middle of as many equal layers of the mesh.
std::vector<double> heightsOf(const SliceArguments& slice, double length, const Mesh& mesh) {
  if (slice.layers == 0) return slice.heights;
  double low = INFINITY, high = -INFINITY;
  for (const uint32_t v : mesh.triangles) {
    double height = 0;
    for (size_t d = 0; d < 3; ++d) height += slice.normal[d] / length * mesh.positions[3 * size_t(v) + d];
    low = std::min(low, height);
    high = std::max(high, height);
  }
  std::vector<double> heights;
  for (int64_t i = 0; i < slice.layers; ++i) heights.push_back(low + (high - low) * ((double(i) + 0.5) / double(slice.layers)));
  return heights;
}

OutlineStack outlineStack(const SliceArguments& slice, const Mesh& mesh, const CutMesh& cutMesh) {
  const auto& [x, y, z] = slice.normal;
  const double length = std::sqrt(x * x + y * y + z * z);
  OutlineStack stack{slice.normal, heightsOf(slice, length, mesh), {}};
  for (double& offset : stack.offsets) offset *= length;
  stack.layers = outlines(cutMesh, stack.normal, stack.offsets);
  return stack;
}

}  // namespace

int runSlice(const Arguments& arguments) {
  checkOutputs(arguments, isOutlineFormat, "outlines are written as .svg, .dxf or .obj");
  const GroupedMesh input{readInput(arguments.mesh), {}};
  const std::optional<CutMesh> cutMesh = cutOrComplain(arguments, input, arguments.grid);
  if (!cutMesh) return kNotCut;
  OnlyArguments only = arguments.only;
  if (!only.any() && cutMesh->hasWinding) only.inside = true;
  const WriteOptions options = writeOptions(only, *cutMesh);
  const OutlineStack stack = outlineStack(arguments.slice, input.mesh, *cutMesh);
  return writeOutputs(arguments, [&](const std::string& output) {
    writeOutput(output, [&](const Sink& sink) { writeOutlines(sink, formatFor(arguments, output), stack, options); });
  });
}

}  // namespace mandoline::cli
