// Files that are written to JavaScript.
#pragma once

#include <string_view>

#include "mandoline/io.h"
#include "results.h"

namespace mandoline::wasm {

/// Gathers the bytes of a file, in JavaScript: here an array would be copied whenever it grows, and memory never shrinks.
class FileBytes {
 public:
  void add(std::string_view piece);
  /// All of them as a Uint8Array.
  val joined() const;

 private:
  val pieces_ = val::array();
  double size_ = 0;
};

/// The bytes that write(sink) gives.
template <class Write>
val bytesOfFile(const Write& write) {
  FileBytes bytes;
  write([&](std::string_view piece) { bytes.add(piece); });
  return success(bytes.joined());
}

/// Options of all writers, and the groups that they point to.
struct Writing {
  explicit Writing(const val& options);
  Writing(const Writing&) = delete;

  WriteOptions given;
  TriangleGroups groups;
};

}  // namespace mandoline::wasm
