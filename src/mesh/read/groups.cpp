// Groups of triangles, read in a second pass through the text of a file, so that callers who need none don't pay for them.
#include <bit>
#include <map>

#include "mesh/read/load_file.h"
#include "mesh/read/readers.h"
#include "mesh/read/text_cursor.h"

namespace mandoline {
namespace detail {
namespace {

bool isUtf8(std::string_view text) {
  constexpr uint32_t kFirst[] = {0, 0, 0x80, 0x800, 0x10000};  // that needs so many bytes
  while (!text.empty()) {
    const auto first = uint8_t(text[0]);
    const int ones = std::countl_one(first);
    const size_t size = ones == 0 ? 1 : size_t(ones);
    if (ones == 1 || ones > 4 || size > text.size()) return false;
    uint32_t code = first & (0x7fu >> ones);
    for (const char c : text.substr(1, size - 1)) {
      if ((uint8_t(c) & 0xc0) != 0x80) return false;
      code = code << 6 | (uint8_t(c) & 0x3f);
    }
    if (code < kFirst[size] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return false;
    text.remove_prefix(size);
  }
  return true;
}

/// A name in UTF-8: as it is, or from Latin-1, which older programs write.
std::string inUtf8(std::string_view name) {
  if (isUtf8(name)) return std::string(name);
  std::string result;
  for (const char c : name) {
    const auto code = uint8_t(c);
    if (code < 0x80) {
      result += c;
    } else {
      result += char(0xc0 | code >> 6);
      result += char(0x80 | (code & 0x3f));
    }
  }
  return result;
}

/// Gives names to triangles as they come.
class Labels {
 public:
  /// Names the triangles that follow.
  void begin(std::string_view name) {
    name_ = name.empty() ? std::string(kDefault) : inUtf8(name);
    group_ = kUnknown;
    begun_ = true;
  }
  void add(size_t triangles) {
    if (triangles == 0) return;
    if (group_ == kUnknown) {
      const auto [known, isNew] = ids_.try_emplace(name_, uint32_t(groups_.names.size()));
      if (isNew) groups_.names.push_back(name_);
      group_ = known->second;
    }
    groups_.triangleGroup.resize(groups_.triangleGroup.size() + triangles, group_);
    hasNamed_ |= begun_;
  }
  /// Whether triangles came after a name.
  bool hasNamed() const { return hasNamed_; }
  TriangleGroups take() { return std::move(groups_); }

 private:
  static constexpr uint32_t kUnknown = ~0u;
  static constexpr std::string_view kDefault = "default";  // what OBJ calls a group without a name
  TriangleGroups groups_;
  std::map<std::string, uint32_t> ids_;
  std::string name_{kDefault};
  uint32_t group_ = kUnknown;  // of name_, once it has a triangle
  bool begun_ = false, hasNamed_ = false;
};

std::string_view firstWord(std::string_view names) { return names.substr(0, names.find_first_of(" \t\v\f")); }

// The polygons and solids of files that readMesh() takes are well-formed; for other files, some groups or a FileError may come out.

TriangleGroups readObjGroups(const FileBytes& file) {
  const auto lacks = [&](std::string_view word) { return file.bytes.find(word) == std::string_view::npos; };
  if (lacks("g") && lacks("usemtl")) return {};  // as most files do
  Labels groups, materials;
  for (TextCursor cursor(file.path, file.bytes); cursor.more(); cursor.nextLine()) {
    const std::string_view keyword = cursor.word("a keyword");
    if (keyword == "g") groups.begin(firstWord(cursor.restOfLine()));
    if (keyword == "usemtl") materials.begin(cursor.restOfLine());
    if (keyword != "f") continue;
    size_t corners = 0;
    for (; cursor.moreOnLine(); ++corners) objCorner(cursor);
    const size_t triangles = corners < 2 ? 0 : corners - 2;
    groups.add(triangles);
    materials.add(triangles);
  }
  if (groups.hasNamed()) return groups.take();
  return materials.hasNamed() ? materials.take() : TriangleGroups();
}

TriangleGroups readStlGroups(const FileBytes& file) {
  if (!isTextStl(file.bytes)) return {};
  constexpr int kWordsOfFacet = 20;  // after "facet": normal and 3 numbers, outer loop, 3 times vertex and 3 numbers, endloop endfacet
  TextCursor cursor(file.path, file.bytes);
  Labels labels;
  size_t solids = 0;
  bool named = false;
  const auto skipWord = [&] {
    cursor.more();
    return cursor.word("a word");
  };
  for (; cursor.more(); ++solids, cursor.nextLine()) {
    skipWord();
    const std::string_view name = cursor.restOfLine();
    labels.begin(name.empty() ? "solid" + std::to_string(solids) : std::string(name));
    size_t triangles = 0;
    for (cursor.nextLine(); lowerCase(skipWord()) == "facet"; ++triangles) {
      for (int i = 0; i < kWordsOfFacet; ++i) skipWord();
    }
    labels.add(triangles);
    named |= triangles > 0 && !name.empty();
  }
  TriangleGroups groups = labels.take();
  return named || groups.names.size() > 1 ? groups : TriangleGroups();
}

TriangleGroups readUnpackedGroups(const FileBytes& file) {
  const MeshFormat format = meshFormatOf(file);
  if (format == MeshFormat::obj) return readObjGroups(file);
  return format == MeshFormat::stl ? readStlGroups(file) : TriangleGroups();
}

}  // namespace
}  // namespace detail

TriangleGroups readGroups(std::span<const char> bytes, const std::string& name) {
  return detail::readWith(detail::readUnpackedGroups, bytes, name);
}

GroupedMesh readGroupedMesh(std::span<const char> bytes, const std::string& name) {
  const auto read = [](const detail::FileBytes& file) { return GroupedMesh{detail::readUnpacked(file), detail::readUnpackedGroups(file)}; };
  return detail::readWith(read, bytes, name);
}

GroupedMesh readGroupedMesh(const std::string& path) {
  try {
    return readGroupedMesh(detail::loadFile(path), path);
  } catch (const std::bad_alloc&) {
    throw FileError(path + ": does not fit into memory");
  }
}

}  // namespace mandoline
