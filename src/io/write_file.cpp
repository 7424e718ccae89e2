#include <list>
#include <optional>

#include "io/output_file.h"
#include "io/poly_mesh.h"

namespace mandoline {
namespace {

namespace fs = std::filesystem;

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

void detail::writeFolder(const std::string& folder, FunctionRef<void(const FolderSink&)> write) {
  constexpr const char* kZones = "cellZones";  // not of every mesh
  std::optional<OutputFolder> made;
  std::list<OutputFile> files;
  std::string last;
  const FolderSink sink = [&](const std::string& file, std::string_view piece) {
    if (!made) made.emplace(folder);
    if (file != last) files.emplace_back((fs::path(folder) / file).string());
    last = file;
    files.back().write(piece);
  };
  try {
    write(sink);
    for (OutputFile& file : files) file.commit();
    if (last != kZones) fs::remove(fs::path(folder) / kZones);  // of a mesh that was here before
  } catch (const fs::filesystem_error& error) {
    throw FileError(folder + ": can't be written: " + error.code().message());
  }
}

void writePolyMesh(const std::string& folder, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options) {
  detail::writeFolder(folder, [&](const FolderSink& sink) { writePolyMesh(sink, cutMesh, cells, options); });
}

}  // namespace mandoline
