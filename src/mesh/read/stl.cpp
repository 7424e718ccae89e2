// STL, in text or binary. Every triangle has its own three vertices, as in the file; cut() welds them.
#include <numeric>

#include "mesh/read/readers.h"
#include "mesh/read/scalar.h"
#include "mesh/read/text_cursor.h"

namespace mandoline::detail {
namespace {

constexpr size_t kHeaderSize = 84, kTriangleSize = 50;  // 80 bytes of anything and the count; normal, three vertices, two bytes

size_t binaryCount(std::string_view bytes) { return loadScalar<uint32_t>(bytes.data() + 80, ByteOrder::little); }

bool isBinaryBySize(std::string_view bytes) { return isBinaryStl(bytes, bytes.size()); }

/// Begins with "solid" and is text. Many binary files begin with "solid" too; they have zero bytes early.
bool isText(std::string_view bytes) {
  TextCursor cursor("", bytes);
  return cursor.more() && lowerCase(cursor.word("solid")) == "solid" && bytes.substr(0, 1024).find('\0') == std::string_view::npos;
}

class TextStlReader {
 public:
  explicit TextStlReader(const FileBytes& file) : cursor_(file.path, file.bytes) {}

  Mesh read() {
    while (cursor_.more()) {
      require("solid");
      cursor_.nextLine();  // its name
      while (readFacet()) {
      }
      cursor_.nextLine();
    }
    return std::move(mesh_);
  }

 private:
  /// False if there is "endsolid" instead.
  bool readFacet() {
    const std::string keyword = next("facet or endsolid");
    if (keyword == "endsolid") return false;
    if (keyword != "facet") cursor_.fail("expected facet or endsolid, found '" + keyword + "'");
    require("normal");
    for (int d = 0; d < 3; ++d) next("a number");  // the vertices tell the normal
    require("outer");
    require("loop");
    for (int i = 0; i < 3; ++i) {
      require("vertex");
      mesh_.triangles.push_back(uint32_t(mesh_.vertexCount()));
      for (int d = 0; d < 3; ++d) {
        cursor_.more();
        mesh_.positions.push_back(cursor_.number());
      }
    }
    require("endloop");
    require("endfacet");
    return true;
  }

  std::string next(const char* expected) {
    cursor_.more();
    return lowerCase(cursor_.word(expected));
  }
  void require(const char* keyword) {
    const std::string found = next(keyword);
    if (found != keyword) cursor_.fail(std::string("expected ") + keyword + ", found '" + found + "'");
  }

  TextCursor cursor_;
  Mesh mesh_;
};

void readCornerPositions(std::string_view bytes, std::span<double> positions) {
  for (size_t t = 0; t < positions.size() / 9; ++t) {
    const char* corners = bytes.data() + kTriangleSize * t + 12;
    for (size_t i = 0; i < 9; ++i) positions[9 * t + i] = double(loadScalar<float>(corners + 4 * i, ByteOrder::little));
  }
}

Mesh readBinary(const FileBytes& file) {
  const auto& [path, bytes] = file;
  if (bytes.size() < kHeaderSize) {
    throw FileError(path + ": byte " + std::to_string(bytes.size()) + ": the file ends within the header of a binary STL file");
  }
  const size_t count = binaryCount(bytes), room = (bytes.size() - kHeaderSize) / kTriangleSize;
  if (count != room) {
    throw FileError(path + ": byte 80: the header of the binary STL file promises " + std::to_string(count) +
                    " triangles, but the file holds " + std::to_string(room));
  }
  Mesh mesh;
  mesh.positions.resize(9 * count);
  mesh.triangles.resize(3 * count);
  readCornerPositions(bytes.substr(kHeaderSize), mesh.positions);
  std::iota(mesh.triangles.begin(), mesh.triangles.end(), 0u);
  return mesh;
}

/// Vertices are read with the triangles that have them.
class StlSource : public MeshSource {
 public:
  StlSource(PartlyRead file, uint64_t count) : file_(std::move(file)) {
    vertices = 3 * count;
    triangles = count;
  }

  void readPositions(uint64_t first, std::span<double> positions) const override {
    const uint64_t begin = first / 3, end = (first + positions.size() / 3 + 2) / 3;
    const std::string bytes = file_.read(kHeaderSize + kTriangleSize * begin, size_t(kTriangleSize * (end - begin)));
    std::vector<double> all(9 * size_t(end - begin));
    readCornerPositions(bytes, all);
    std::copy_n(all.begin() + ptrdiff_t(3 * (first % 3)), positions.size(), positions.begin());
  }
  void readCorners(uint64_t first, std::span<uint32_t> corners) const override {
    std::iota(corners.begin(), corners.end(), uint32_t(3 * first));
  }

 private:
  const PartlyRead file_;
};

}  // namespace

bool isBinaryStl(std::string_view head, uint64_t size) {
  return head.size() >= kHeaderSize && size == kHeaderSize + kTriangleSize * binaryCount(head);
}

std::shared_ptr<const MeshSource> openStl(PartlyRead file) {
  constexpr size_t kMost = ~uint32_t(0) / 3;  // so that vertices have ids
  const std::string head = file.read(0, size_t(std::min<uint64_t>(file.size(), kHeaderSize)));
  if (!isBinaryStl(head, file.size()) || binaryCount(head) > kMost) return nullptr;
  return std::make_shared<const StlSource>(std::move(file), binaryCount(head));
}

bool looksLikeStl(std::string_view bytes) { return isBinaryBySize(bytes) || isText(bytes); }

bool isTextStl(std::string_view bytes) { return !isBinaryBySize(bytes) && isText(bytes); }

Mesh readStl(const FileBytes& file) {
  if (isTextStl(file.bytes)) return TextStlReader(file).read();
  return readBinary(file);
}

}  // namespace mandoline::detail
