#include "io/output_file.h"

namespace mandoline {
namespace {

template <class Write>
void writeFile(const std::string& path, const Write& write) {
  detail::OutputFile file(path);
  write([&](std::string_view bytes) { file.write(bytes); });
  file.commit();
}

}  // namespace

void checkOutput(const std::string& path) {
  const std::optional<FileFormat> format = formatOf(path);
  if (!format || !isCutMeshFormat(*format)) throw FileError(path + ": the extension must be .json, .mcm, .vtu, .obj, .stl or .ply");
  detail::checkPlace(path);
}

void writeCutMesh(const std::string& path, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options) {
  checkOutput(path);
  writeFile(path, [&](const Sink& sink) { writeCutMesh(sink, *formatOf(path), mesh, cutMesh, options); });
}

void writeMesh(const std::string& path, const MeshView& mesh, const RunOptions& options, const TriangleGroups* groups) {
  const std::optional<FileFormat> format = formatOf(path);
  if (!format || !isMeshFormat(*format)) {
    throw FileError(path + ": the extension must be .obj, .stl, .ply or .off");
  }
  detail::checkPlace(path);
  writeFile(path, [&](const Sink& sink) { writeMesh(sink, *format, mesh, options, groups); });
}

}  // namespace mandoline
