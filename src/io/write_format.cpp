#include <algorithm>
#include <iterator>

#include "io/selection.h"
#include "mesh/read/text_cursor.h"

namespace mandoline {
namespace {

constexpr const char* kNames[] = {"json", "mcm", "vtu", "obj", "stl", "ply", "off", "svg", "dxf"};  // in the order of FileFormat

}  // namespace

const char* name(FileFormat format) { return kNames[size_t(format)]; }

std::optional<FileFormat> formatOf(const std::string& path) {
  const size_t dot = path.find_last_of("./\\");
  if (dot == std::string::npos || path[dot] != '.') return std::nullopt;
  const std::string extension = detail::lowerCase(std::string_view(path).substr(dot + 1));
  const auto found = std::find(std::begin(kNames), std::end(kNames), extension);
  if (found == std::end(kNames)) return std::nullopt;
  return FileFormat(found - std::begin(kNames));
}

bool isCutMeshFormat(FileFormat format) { return format <= FileFormat::ply; }
bool isMeshFormat(FileFormat format) { return FileFormat::obj <= format && format <= FileFormat::off; }
bool isOutlineFormat(FileFormat format) { return format == FileFormat::svg || format == FileFormat::dxf || format == FileFormat::obj; }

void writeCutMesh(const Sink& sink, FileFormat format, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options) {
  if (format == FileFormat::json || format == FileFormat::mcm) detail::requireAll(options);
  switch (format) {
    case FileFormat::json:
      return options.groups ? writeJson(sink, cutMesh, *options.groups, options) : writeJson(sink, cutMesh, options);
    case FileFormat::mcm:
      return writeMcm(sink, cutMesh, options);
    case FileFormat::vtu:
      return writeVtu(sink, mesh, cutMesh, options);
    case FileFormat::obj:
      return writeObj(sink, cutMesh, options);
    case FileFormat::stl:
      return writeStl(sink, cutMesh, options);
    case FileFormat::ply:
      return writePly(sink, cutMesh, options);
    default:
      throw FileError(std::string("cut-meshes can't be written as .") + name(format));
  }
}

}  // namespace mandoline
