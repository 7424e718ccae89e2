#include "cli/input.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "cli/files.h"
#include "cli/mesh_report.h"
#include "cli/progress_bar.h"
#include "mandoline/orient.h"

namespace mandoline::cli {
namespace {

std::string readStandardInput() {
  std::string bytes;
  size_t count = 0;
  do {
    bytes.resize(std::max(2 * count, size_t(1) << 16));
    count += std::fread(bytes.data() + count, 1, bytes.size() - count, stdin);
  } while (count == bytes.size());
  if (std::ferror(stdin)) throw FileError(std::string("standard input: ") + std::strerror(errno));
  bytes.resize(count);
  return bytes;
}

/// Turns the triangles of the mesh. One that can't be oriented can't be cut either, for the same reason: it is left to the command to say.
void orient(Input& input, unsigned threads) {
  try {
    OrientedMesh oriented = withProgress(threads, [&](const RunOptions& options) { return mandoline::orient(input.mesh, options); });
    input.mesh = std::move(oriented.mesh);
    input.orientation = Orientation{oriented.turnedTriangles.size(), {}};
    for (const Facing facing : oriented.patchFacing) ++input.orientation->patches[size_t(facing)];
  } catch (const CallError&) {
  }
}

GroupedMesh readGroups(const std::string& path) {
  return path == "-" ? readGroupedMesh(readStandardInput(), nameOf(path)) : readGroupedMesh(path);
}

void reportFailure(const Arguments& arguments, const std::string& message) {
  if (arguments.report.empty()) return;
  Json json;
  addHead(json, {"badFile", message + "."}, nameOf(arguments.mesh));
  json.key("mesh").null().close('}');
  writeOutput(arguments.report, [&](const Sink& sink) { sink(json.text()); });
}

}  // namespace

std::string nameOf(const std::string& meshPath) { return meshPath == "-" ? "standard input" : meshPath; }

Input readInput(const Arguments& arguments) {
  try {
    Input input{readGroups(arguments.mesh), nameOf(arguments.mesh), {}};
    if (arguments.orient) orient(input, arguments.threads);
    return input;
  } catch (const FileError& error) {
    reportFailure(arguments, error.what());
    throw;
  }
}

}  // namespace mandoline::cli
