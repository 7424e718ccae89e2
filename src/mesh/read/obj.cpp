// Wavefront OBJ: vertices and polygons; everything else is skipped.
#include <algorithm>
#include <array>

#include "mesh/read/readers.h"
#include "mesh/read/text_cursor.h"

namespace mandoline::detail {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const FileBytes& file) : cursor_(file.path, file.bytes) {}

  Mesh read() {
    for (; cursor_.more(); cursor_.nextLine()) {
      const std::string_view keyword = cursor_.word("a keyword");
      if (keyword == "v") readVertex();
      if (keyword == "f") readFace();
    }
    for (const ForwardReference& reference : forwardReferences_) {
      if (reference.index > vertexCount()) failIndex(reference.line, reference.index);
    }
    return std::move(mesh_);
  }

 private:
  struct ForwardReference {
    int64_t index;
    size_t line;
  };

  int64_t vertexCount() const { return int64_t(mesh_.vertexCount()); }

  void readVertex() {
    for (int d = 0; d < 3; ++d) mesh_.positions.push_back(cursor_.number());
    while (cursor_.moreOnLine()) cursor_.number();  // weight or colour
  }

  void readFace() {
    Fan fan(mesh_.triangles);
    while (cursor_.moreOnLine()) fan.add(readCorner());
    if (fan.count() < 3) cursor_.fail("a face needs at least three vertices, found " + std::to_string(fan.count()));
  }

  uint32_t readCorner() {
    const int64_t index = objCorner(cursor_);
    if (index == 0 || index < -vertexCount()) failIndex(cursor_.line(), index);
    if (index < 0) return uint32_t(vertexCount() + index);
    if (index > vertexCount()) forwardReferences_.push_back({index, cursor_.line()});
    return uint32_t(index - 1);
  }

  [[noreturn]] void failIndex(size_t line, int64_t index) const {
    cursor_.failAt(line, "there is no vertex " + std::to_string(index) + " (vertices are numbered from 1; there are " +
                             std::to_string(vertexCount()) + ")");
  }

  TextCursor cursor_;
  Mesh mesh_;
  std::vector<ForwardReference> forwardReferences_;  // to vertices that come after the face
};

}  // namespace

int64_t objCorner(TextCursor& cursor) {
  const int64_t index = cursor.leadingInteger();
  for (int i = 0; i < 2 && cursor.skip('/'); ++i) {
    if (!cursor.atWordEnd() && !cursor.at('/')) cursor.leadingInteger();
  }
  cursor.requireWordEnd("a vertex such as 1, 1/2, 1//3 or 1/2/3");
  return index;
}

bool looksLikeObj(std::string_view bytes) {
  static constexpr std::array<std::string_view, 14> keywords = {"v", "vt", "vn", "vp", "f",   "o",      "g",
                                                                "s", "l",  "p",  "mg", "lod", "usemtl", "mtllib"};
  TextCursor cursor("", bytes);
  return cursor.more() && std::find(keywords.begin(), keywords.end(), cursor.word("a keyword")) != keywords.end();
}

Mesh readObj(const FileBytes& file) { return ObjReader(file).read(); }

}  // namespace mandoline::detail
