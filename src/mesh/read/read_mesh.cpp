#include <limits>

#include "mesh/read/readers.h"
#include "mesh/read/text_cursor.h"
#include "mesh/read/unread_formats.h"

namespace mandoline {
namespace detail {
namespace {

/// In lower case with its dot, not counting ".gz".
std::string extensionOf(const std::string& name) {
  std::string lower = lowerCase(name);
  if (lower.ends_with(".gz")) lower.resize(lower.size() - 3);
  const size_t dot = lower.find_last_of("./\\");
  return dot == std::string::npos || lower[dot] != '.' ? "" : lower.substr(dot);
}

Mesh checked(Mesh mesh, const FileBytes& file) {
  if (mesh.vertexCount() > std::numeric_limits<uint32_t>::max()) throw FileError(file.path + ": has more than 2^32 vertices");
  return mesh;
}

std::optional<Mesh> readUnpackedObjOrStl(const FileBytes& file) {
  if (looksLikePly(file.bytes) || looksLikeOff(file.bytes)) return std::nullopt;
  if (looksLikeStl(file.bytes)) return checked(readStl(file), file);
  if (!looksLikeObj(file.bytes)) return std::nullopt;
  Mesh mesh = checked(readObj(file), file);
  if (mesh.triangles.empty()) return std::nullopt;  // it may be of a format that is not read
  return mesh;
}

void refuse(const FileBytes& file, const UnreadFormat* format) {
  if (format == nullptr) return;
  throw FileError(file.path + ": this is " + std::string(format->name) + ", not OBJ, STL, PLY or OFF: " + std::string(format->way));
}

}  // namespace

MeshFormat meshFormatOf(const FileBytes& file) {
  const std::string extension = extensionOf(file.path);
  if (looksLikePly(file.bytes)) return MeshFormat::ply;
  if (looksLikeOff(file.bytes)) return MeshFormat::off;
  if (looksLikeStl(file.bytes)) return MeshFormat::stl;
  refuse(file, unreadByContent(file.bytes));
  if (looksLikeObj(file.bytes) || extension == ".obj") return MeshFormat::obj;
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".off") return MeshFormat::off;
  refuse(file, unreadByExtension(extension));
  throw FileError(file.path + ": neither the content nor the name is that of an OBJ, STL, PLY or OFF file");
}

Mesh readUnpacked(const FileBytes& file) {
  if (file.bytes.empty()) throw FileError(file.path + ": the file is empty");
  const MeshFormat format = meshFormatOf(file);
  return checked(format == MeshFormat::ply   ? readPly(file)
                 : format == MeshFormat::off ? readOff(file)
                 : format == MeshFormat::stl ? readStl(file)
                                             : readObj(file),
                 file);
}

}  // namespace detail

Mesh readMesh(std::span<const char> bytes, const std::string& name) { return detail::readWith(detail::readUnpacked, bytes, name); }

std::optional<Mesh> readObjOrStl(std::span<const char> bytes, const std::string& name) {
  return detail::readWith(detail::readUnpackedObjOrStl, bytes, name);
}

}  // namespace mandoline
