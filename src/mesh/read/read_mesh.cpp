#include <filesystem>
#include <limits>
#include <new>

#include "mesh/read/readers.h"
#include "mesh/read/text_cursor.h"

namespace mandoline {
namespace detail {
namespace {

/// In small letters with its dot, not counting ".gz".
std::string extensionOf(const std::string& path) {
  std::filesystem::path name = std::filesystem::path(path).filename();
  if (lowerCase(name.extension().string()) == ".gz") name = name.stem();
  return lowerCase(name.extension().string());
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

Mesh readMesh(const std::string& path) {
  try {
    const std::string bytes = detail::loadFile(path);
    Mesh mesh = detail::readAny({path, bytes});
    if (mesh.vertexCount() > std::numeric_limits<uint32_t>::max()) throw FileError(path + ": has more than 2^32 vertices");
    return mesh;
  } catch (const std::bad_alloc&) {
    throw FileError(path + ": does not fit into memory");
  }
}

}  // namespace mandoline
