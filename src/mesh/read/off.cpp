// Object File Format: OFF in text, with normals, colours or texture coordinates (NOFF, COFF, STOFF), which are skipped.
#include "mesh/read/readers.h"
#include "mesh/read/text_cursor.h"

namespace mandoline::detail {
namespace {

/// Length of the header word (ST)(C)(N)(4)(n)OFF at the beginning of the text, or 0.
size_t headerLength(std::string_view text) {
  size_t length = 0;
  for (const std::string_view part : {"ST", "C", "N", "4", "n"}) {
    if (text.substr(length, part.size()) == part) length += part.size();
  }
  return text.substr(length, 3) == "OFF" ? length + 3 : 0;
}

class OffReader {
 public:
  explicit OffReader(const FileBytes& file) : cursor_(file.path, file.bytes) {}

  Mesh read() {
    readHeader();
    const size_t vertexCount = readCount("vertices", 6);  // "0 0 0\n"
    const size_t faceCount = readCount("faces", 8);       // "3 0 1 2\n"
    cursor_.nextLine();                                   // the number of edges
    mesh_.positions.reserve(3 * vertexCount);
    mesh_.triangles.reserve(3 * faceCount);
    for (size_t v = 0; v < vertexCount; ++v) readVertex(v, vertexCount);
    for (size_t f = 0; f < faceCount; ++f) readFace(f, faceCount);
    if (cursor_.more()) cursor_.fail("more follows after the last of " + std::to_string(faceCount) + " faces");
    return std::move(mesh_);
  }

 private:
  void readHeader() {
    if (!cursor_.more()) cursor_.fail("expected OFF, found the end of the file");
    const std::string_view rest(cursor_.position(), cursor_.remaining());
    const size_t length = headerLength(rest);
    const std::string_view header = rest.substr(0, length);
    if (header.find_first_of("4n") != std::string_view::npos) cursor_.fail("only three-dimensional OFF files can be read");
    for (size_t i = 0; i < length; ++i) cursor_.skip(rest[i]);  // the counts may follow without a space
    if (cursor_.more() && std::string_view(cursor_.position(), cursor_.remaining()).substr(0, 6) == "BINARY") {
      cursor_.fail("binary OFF files can't be read");
    }
  }

  size_t readCount(const char* what, size_t bytesEach) {
    cursor_.more();
    const int64_t count = cursor_.integer();
    // The last line may lack its end.
    if (count < 0 || uint64_t(count) > (cursor_.remaining() + 1) / bytesEach) {
      cursor_.fail(std::to_string(count) + " " + what + " can't be in a file of this size");
    }
    return size_t(count);
  }

  void requireItem(const char* kind, size_t index, size_t count) {
    if (cursor_.more()) return;
    cursor_.fail(std::string("the file ends before ") + kind + " " + std::to_string(index) + " of " + std::to_string(count));
  }

  void readVertex(size_t v, size_t vertexCount) {
    requireItem("vertex", v, vertexCount);
    for (int d = 0; d < 3; ++d) mesh_.positions.push_back(cursor_.number());
    while (cursor_.moreOnLine()) cursor_.number();  // normal, colour, texture coordinates
  }

  void readFace(size_t f, size_t faceCount) {
    requireItem("face", f, faceCount);
    const int64_t size = cursor_.integer();
    if (size < 3) cursor_.fail("a face needs at least three vertices, found " + std::to_string(size));
    Fan fan(mesh_.triangles);
    for (int64_t i = 0; i < size; ++i) {
      const int64_t index = cursor_.integer();
      if (index < 0 || uint64_t(index) >= mesh_.vertexCount()) {
        cursor_.fail("there is no vertex " + std::to_string(index) + " (vertices are numbered from 0; there are " +
                     std::to_string(mesh_.vertexCount()) + ")");
      }
      fan.add(uint32_t(index));
    }
    cursor_.nextLine();  // colour
  }

  TextCursor cursor_;
  Mesh mesh_;
};

}  // namespace

bool looksLikeOff(std::string_view bytes) {
  TextCursor cursor("", bytes);
  return cursor.more() && headerLength({cursor.position(), cursor.remaining()}) > 0;
}

Mesh readOff(const FileBytes& file) { return OffReader(file).read(); }

}  // namespace mandoline::detail
