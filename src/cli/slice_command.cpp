#include <algorithm>
#include <cmath>
#include <sstream>

#include "cli/commands.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/mesh_report.h"

namespace mandoline::cli {
namespace {

double lengthOf(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// The lowest and the highest vertex of the mesh along the normal.
std::array<double, 2> reachOf(const SliceArguments& slice, const Mesh& mesh) {
  const double length = lengthOf(slice.normal);
  std::array<double, 2> reach = {INFINITY, -INFINITY};
  for (const uint32_t v : mesh.triangles) {
    double height = 0;
    for (size_t d = 0; d < 3; ++d) height += slice.normal[d] / length * mesh.positions[3 * size_t(v) + d];
    reach = {std::min(reach[0], height), std::max(reach[1], height)};
  }
  return reach;
}

/// The heights that were asked for, or those in the middle of as many equal layers of the mesh.
std::vector<double> heightsOf(const SliceArguments& slice, const std::array<double, 2>& reach) {
  if (slice.layers == 0) return slice.heights;
  std::vector<double> heights;
  for (int64_t i = 0; i < slice.layers; ++i)
    heights.push_back(reach[0] + (reach[1] - reach[0]) * ((double(i) + 0.5) / double(slice.layers)));
  return heights;
}

OutlineStack outlineStack(const SliceArguments& slice, const std::vector<double>& heights, const CutMesh& cutMesh) {
  OutlineStack stack{slice.normal, heights, {}};
  for (double& offset : stack.offsets) offset *= lengthOf(slice.normal);
  stack.layers = outlines(cutMesh, stack.normal, stack.offsets);
  return stack;
}

/// How many polygons and slits of the regions that are written there are.
std::array<size_t, 2> shapesOf(const Outlines& layer, const WriteOptions& options) {
  const auto count = [&](const std::vector<uint32_t>& regions) {
    return size_t(std::count_if(regions.begin(), regions.end(), [&](uint32_t r) { return options.hasRegion(r); }));
  };
  return {count(layer.polygonRegion), count(layer.slitRegion)};
}

/// What there is to tell of the outlines.
struct SliceReport {
  const MeshReport& mesh;
  const std::vector<double>& heights;
  std::array<double, 2> reach;
  std::vector<std::array<size_t, 2>> shapes;  ///< per height: polygons and slits

  bool isEmpty(size_t layer) const { return shapes[layer][0] + shapes[layer][1] == 0; }
  size_t emptyLayers() const {
    size_t count = 0;
    for (size_t i = 0; i < heights.size(); ++i) count += isEmpty(i);
    return count;
  }
  /// Which heights meet nothing; empty if none.
  std::string note() const {
    const size_t count = emptyLayers();
    if (count == 0) return "";
    std::ostringstream text;
    text << "Nothing is cut at " << (count == 1 ? "height" : "heights");
    for (size_t i = 0; i < heights.size(); ++i) {
      if (isEmpty(i)) text << ' ' << heights[i];
    }
    text << ": the mesh reaches from " << reach[0] << " to " << reach[1] << " along the normal.";
    return text.str();
  }
  Outcome outcome() const {
    if (emptyLayers() < heights.size()) return {"ok", note()};
    return {"nothingCut", note()};
  }
  std::string json() const {
    Json json;
    addHead(json, outcome(), mesh);
    json.key("layers").open('[');
    for (size_t i = 0; i < heights.size(); ++i) {
      json.open('{').member("height", heights[i]).member("polygons", shapes[i][0]).member("slits", shapes[i][1]).close('}');
    }
    return json.close(']').close('}').text();
  }
};

}  // namespace

int runSlice(const Arguments& arguments) {
  checkOutputs(arguments, isOutlineFormat, "outlines are written as .svg, .dxf or .obj");
  const Input input = readInput(arguments);
  const std::optional<CutResult> cut = cutOrComplain(arguments, input, arguments.grid);
  if (!cut) return kNotCut;
  const WriteOptions options = writeOptions(arguments, *cut);
  if (arguments.only.any()) requireSelection(options, cut->mesh);
  const MeshReport mesh{input, inspect(input.mesh), {}};
  const std::array<double, 2> reach = reachOf(arguments.slice, input.mesh);
  const std::vector<double> heights = heightsOf(arguments.slice, reach);
  const OutlineStack stack = outlineStack(arguments.slice, heights, cut->mesh);
  SliceReport report{mesh, heights, reach, {}};
  for (const Outlines& layer : stack.layers) report.shapes.push_back(shapesOf(layer, options));
  if (!report.note().empty()) complain(input.name + ": " + report.note());
  int exitCode = kFine;
  attempt(exitCode, [&] { writeReport(arguments, [&] { return report.json(); }); });
  if (report.emptyLayers() == heights.size()) return kNotCut;
  const auto write = [&](const std::string& output) {
    writeOutput(output, [&](const Sink& sink) { writeOutlines(sink, formatFor(arguments, output), stack, options); });
  };
  return writeOutputs(arguments, write, exitCode);
}

}  // namespace mandoline::cli
