#include <limits>
#include <new>

#include "mesh/read/readers.h"
#include "mesh/read/text_cursor.h"

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

/// Content decides, because extensions lie; where it says nothing, the extension does.
Mesh readAny(const FileBytes& file) {
  const std::string extension = extensionOf(file.path);
  if (looksLikePly(file.bytes)) return readPly(file);
  if (looksLikeOff(file.bytes)) return readOff(file);
  if (looksLikeStl(file.bytes)) return readStl(file);
  if (looksLikeObj(file.bytes) || extension == ".obj") return readObj(file);
  if (extension == ".stl") return readStl(file);
  if (extension == ".ply") return readPly(file);
  if (extension == ".off") return readOff(file);
  throw FileError(file.path + ": neither the content nor the name is that of an OBJ, STL, PLY or OFF file");
}

}  // namespace
}  // namespace detail

Mesh readMesh(std::span<const char> bytes, const std::string& name) {
  const std::string_view content(bytes.data(), bytes.size());
  try {
    std::string unpacked;
    const bool gzipped = detail::isGzipped(content);
    if (gzipped) unpacked = detail::gunzip({name, content});
    const detail::FileBytes file{name, gzipped ? unpacked : content};
    if (file.bytes.empty()) throw FileError(name + ": the file is empty");
    Mesh mesh = detail::readAny(file);
    if (mesh.vertexCount() > std::numeric_limits<uint32_t>::max()) throw FileError(name + ": has more than 2^32 vertices");
    return mesh;
  } catch (const std::bad_alloc&) {
    throw FileError(name + ": does not fit into memory");
  }
}

}  // namespace mandoline
