#include "io/output_buffer.h"
#include "mesh/read/text_cursor.h"

namespace mandoline {
namespace {

constexpr FileFormat kFormats[] = {FileFormat::json, FileFormat::vtu, FileFormat::obj, FileFormat::stl, FileFormat::ply, FileFormat::off};

}  // namespace

const char* name(FileFormat format) {
  constexpr const char* kNames[] = {"json", "vtu", "obj", "stl", "ply", "off"};
  return kNames[size_t(format)];
}

std::optional<FileFormat> formatOf(const std::string& path) {
  const size_t dot = path.find_last_of("./\\");
  if (dot == std::string::npos || path[dot] != '.') return std::nullopt;
  const std::string extension = detail::lowerCase(std::string_view(path).substr(dot + 1));
  for (const FileFormat format : kFormats) {
    if (extension == name(format)) return format;
  }
  return std::nullopt;
}

void writeCutMesh(const Sink& sink, FileFormat format, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options) {
  switch (format) {
    case FileFormat::json:
      return writeJson(sink, cutMesh);
    case FileFormat::vtu:
      return writeVtu(sink, mesh, cutMesh, options);
    case FileFormat::obj:
      return writeObj(sink, cutMesh, options);
    case FileFormat::stl:
      return writeStl(sink, cutMesh, options);
    case FileFormat::ply:
      return writePly(sink, cutMesh, options);
    case FileFormat::off:
      throw FileError("cut-meshes can't be written as .off");
  }
}

}  // namespace mandoline
