// The readers behind readMesh(), one per format. Each takes the unpacked bytes of a file and throws FileError.
#pragma once

#include <fstream>
#include <new>
#include <optional>
#include <string>
#include <string_view>

#include "mandoline/mesh_files.h"
#include "mesh/mesh_source.h"

namespace mandoline::detail {

/// What every reader gets to see: the path is for messages only.
struct FileBytes {
  std::string path;
  std::string_view bytes;
};

Mesh readObj(const FileBytes& file);
Mesh readOff(const FileBytes& file);
Mesh readPly(const FileBytes& file);
Mesh readStl(const FileBytes& file);

/// A file of which some bytes are read.
class PartlyRead {
 public:
  /// Throws FileError for what can't be read; it is to be a regular file.
  explicit PartlyRead(const std::string& path);

  const std::string& path() const { return path_; }
  uint64_t size() const { return size_; }
  std::string read(uint64_t offset, size_t count) const;

 private:
  std::string path_;
  mutable std::ifstream file_;
  uint64_t size_ = 0;
};
/// Nothing where records differ in size, or the file is not binary.
std::shared_ptr<const MeshSource> openPly(PartlyRead file);
std::shared_ptr<const MeshSource> openStl(PartlyRead file);

bool looksLikeObj(std::string_view bytes);
bool looksLikeOff(std::string_view bytes);
bool looksLikePly(std::string_view bytes);
bool looksLikeStl(std::string_view bytes);

/// Whether a binary STL file of so many bytes may begin so.
bool isBinaryStl(std::string_view head, uint64_t size);
/// Whether an STL file is text, which has names.
bool isTextStl(std::string_view bytes);

enum class MeshFormat { obj, stl, ply, off };
/// Content decides, because extensions lie; where it says nothing, the extension does. Throws FileError.
MeshFormat meshFormatOf(const FileBytes& file);
/// Reads a file of any format.
Mesh readUnpacked(const FileBytes& file);

/// Takes a corner of an OBJ file's polygon, v, v/vt, v//vn or v/vt/vn, and gives v.
int64_t objCorner(class TextCursor& cursor);

inline bool isGzipped(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }
/// What is packed in a gzipped file. Throws FileError where the library was built without zlib.
std::string gunzip(const FileBytes& file);

/// Gives read(file), of a file that is unpacked if need be.
template <class Read>
auto readWith(const Read& read, std::span<const char> bytes, const std::string& name) {
  const std::string_view content(bytes.data(), bytes.size());
  try {
    std::string unpacked;
    const bool gzipped = isGzipped(content);
    if (gzipped) unpacked = gunzip({name, content});
    return read(FileBytes{name, gzipped ? unpacked : content});
  } catch (const std::bad_alloc&) {
    throw FileError(name + ": does not fit into memory");
  }
}

/// Fans a polygon into triangles from its first vertex, as its vertices arrive.
class Fan {
 public:
  explicit Fan(std::vector<uint32_t>& triangles) : triangles_(triangles) {}
  void add(uint32_t vertex) {
    if (count_ == 0) first_ = vertex;
    if (count_ >= 2) triangles_.insert(triangles_.end(), {first_, previous_, vertex});
    previous_ = vertex;
    ++count_;
  }
  size_t count() const { return count_; }

 private:
  std::vector<uint32_t>& triangles_;
  uint32_t first_ = 0, previous_ = 0;
  size_t count_ = 0;
};

}  // namespace mandoline::detail
