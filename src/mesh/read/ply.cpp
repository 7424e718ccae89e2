// PLY, in text or binary of either byte order: x, y, z of the element "vertex" and vertex_indices of the element "face". Other
// elements and properties are skipped.

#include "mesh/read/readers.h"
#include "mesh/read/scalar.h"
#include "mesh/read/text_cursor.h"

namespace mandoline::detail {
namespace {

enum class Type : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  const char* name;
  Type type;
  size_t size;
};
constexpr TypeName kTypes[] = {
    {"char", Type::int8, 1},   {"uchar", Type::uint8, 1},   {"short", Type::int16, 2},     {"ushort", Type::uint16, 2},
    {"int", Type::int32, 4},   {"uint", Type::uint32, 4},   {"float", Type::float32, 4},   {"double", Type::float64, 8},
    {"int8", Type::int8, 1},   {"uint8", Type::uint8, 1},   {"int16", Type::int16, 2},     {"uint16", Type::uint16, 2},
    {"int32", Type::int32, 4}, {"uint32", Type::uint32, 4}, {"float32", Type::float32, 4}, {"float64", Type::float64, 8}};

bool isFloat(const TypeName& type) { return type.type == Type::float32 || type.type == Type::float64; }

enum class Role : uint8_t { skipped, x, y, z, corners };

struct Property {
  TypeName type;
  bool isList = false;
  TypeName countType;
  Role role = Role::skipped;
};

struct Element {
  std::string name;
  uint64_t count = 0;
  size_t line = 0;
  std::vector<Property> properties;

  bool has(Role role) const {
    for (const Property& p : properties) {
      if (p.role == role) return true;
    }
    return false;
  }
};

enum class Encoding : uint8_t { text, binaryLittle, binaryBig };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  uint64_t vertexCount = 0;
};

TypeName readType(TextCursor& cursor) {
  const std::string_view word = cursor.word("a type");
  for (const TypeName& type : kTypes) {
    if (word == type.name) return type;
  }
  cursor.fail("unknown type '" + std::string(word) + "'");
}

Encoding readEncoding(TextCursor& cursor) {
  const std::string_view word = cursor.word("ascii, binary_little_endian or binary_big_endian");
  if (word == "ascii") return Encoding::text;
  if (word == "binary_little_endian") return Encoding::binaryLittle;
  if (word == "binary_big_endian") return Encoding::binaryBig;
  cursor.fail("unknown format '" + std::string(word) + "'");
}

Role roleOf(const std::string& element, std::string_view property, bool isList) {
  if (element == "vertex" && !isList) {
    if (property == "x") return Role::x;
    if (property == "y") return Role::y;
    if (property == "z") return Role::z;
  }
  if (element == "face" && isList && (property == "vertex_indices" || property == "vertex_index")) return Role::corners;
  return Role::skipped;
}

Property readProperty(TextCursor& cursor, const Element& element) {
  Property property;
  cursor.moreOnLine();
  property.isList = std::string_view(cursor.position(), cursor.remaining()).substr(0, 5) == "list ";
  if (property.isList) {
    cursor.word("list");
    property.countType = readType(cursor);
    if (isFloat(property.countType)) cursor.fail("the length of a list must be of an integer type");
  }
  property.type = readType(cursor);
  property.role = roleOf(element.name, cursor.word("a property's name"), property.isList);
  if (property.role != Role::skipped && element.has(property.role)) cursor.fail("the property occurs twice");
  if (property.role == Role::corners && isFloat(property.type)) cursor.fail("vertex indices must be of an integer type");
  return property;
}

Element readElement(TextCursor& cursor) {
  Element element;
  element.name = cursor.word("an element's name");
  element.line = cursor.line();
  const int64_t count = cursor.integer();
  if (count < 0) cursor.fail("the element " + element.name + " has a negative count");
  element.count = uint64_t(count);
  return element;
}

void checkElements(const TextCursor& cursor, Header& header) {
  size_t vertexElements = 0, faceElements = 0;
  for (const Element& e : header.elements) {
    if (e.name == "vertex") {
      ++vertexElements;
      header.vertexCount = e.count;
      if (!(e.has(Role::x) && e.has(Role::y) && e.has(Role::z))) cursor.failAt(e.line, "the element vertex lacks x, y or z");
    }
    if (e.name == "face") {
      ++faceElements;
      if (!e.has(Role::corners)) cursor.failAt(e.line, "the element face lacks the list vertex_indices");
    }
    if (e.name == "tristrips") cursor.failAt(e.line, "triangle strips can't be read");
  }
  if (vertexElements != 1 || faceElements > 1) cursor.fail("the header needs one element vertex and at most one element face");
}

/// Leaves the cursor behind the line "end_header".
Header readHeader(TextCursor& cursor) {
  Header header;
  cursor.nextLine();  // "ply"
  bool hasFormat = false;
  for (;; cursor.nextLine()) {
    if (!cursor.more()) cursor.fail("the file ends within its header");
    const std::string_view keyword = cursor.word("a keyword");
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.encoding = readEncoding(cursor);
      hasFormat = true;
    } else if (keyword == "element") {
      header.elements.push_back(readElement(cursor));
    } else if (keyword == "property") {
      if (header.elements.empty()) cursor.fail("a property without an element");
      header.elements.back().properties.push_back(readProperty(cursor, header.elements.back()));
    } else if (keyword != "comment" && keyword != "obj_info") {
      cursor.fail("unknown keyword '" + std::string(keyword) + "' in the header");
    }
  }
  if (!hasFormat) cursor.fail("the header lacks the line 'format'");
  cursor.nextLine();
  checkElements(cursor, header);
  return header;
}

/// The data as words.
class TextSource {
 public:
  explicit TextSource(TextCursor& cursor) : cursor_(cursor) {}

  static size_t leastSize(const TypeName&) { return 2; }        // a digit and a space
  size_t remaining() const { return cursor_.remaining() + 1; }  // the last word may lack the space
  double number(const TypeName&) { return cursor_.more(), cursor_.number(); }
  int64_t integer(const TypeName&) { return cursor_.more(), cursor_.integer(); }
  void skip(const TypeName&, uint64_t count) {
    for (; count > 0; --count) {
      cursor_.more();
      cursor_.word("a number");
    }
  }
  void beginItem(const Element& element, uint64_t index) {
    if (cursor_.more()) return;
    cursor_.fail("the file ends before " + element.name + " " + std::to_string(index) + " of " + std::to_string(element.count));
  }
  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }

 private:
  TextCursor& cursor_;
};

/// The data as bytes.
class BinarySource {
 public:
  BinarySource(const FileBytes& file, size_t begin, ByteOrder order) : file_(file), offset_(begin), order_(order) {}

  static size_t leastSize(const TypeName& type) { return type.size; }
  size_t remaining() const { return file_.bytes.size() - offset_; }

  double number(const TypeName& type) {
    if (type.type == Type::float32) return double(take<float>());
    if (type.type == Type::float64) return take<double>();
    return double(integer(type));
  }
  int64_t integer(const TypeName& type) {
    switch (type.type) {
      case Type::int8:
        return take<int8_t>();
      case Type::uint8:
        return take<uint8_t>();
      case Type::int16:
        return take<int16_t>();
      case Type::uint16:
        return take<uint16_t>();
      case Type::int32:
        return take<int32_t>();
      case Type::uint32:
        return take<uint32_t>();
      default:
        return int64_t(number(type));
    }
  }
  void skip(const TypeName& type, uint64_t count) {
    require(type.size * count);
    offset_ += type.size * count;
  }
  void beginItem(const Element& element, uint64_t index) {
    element_ = &element;
    index_ = index;
  }
  [[noreturn]] void fail(const std::string& message) const {
    std::string place;
    if (element_) place = element_->name + " " + std::to_string(index_) + ": ";
    throw FileError(file_.path + ": byte " + std::to_string(offset_) + ": " + place + message);
  }

 private:
  void require(size_t size) const {
    if (size > remaining()) fail("the file ends here");
  }
  template <class Scalar>
  Scalar take() {
    require(sizeof(Scalar));
    const Scalar value = loadScalar<Scalar>(file_.bytes.data() + offset_, order_);
    offset_ += sizeof(Scalar);
    return value;
  }

  const FileBytes& file_;
  size_t offset_;
  ByteOrder order_;
  const Element* element_ = nullptr;
  uint64_t index_ = 0;
};

template <class Source>
class DataReader {
 public:
  DataReader(Source source, const Header& header, const TextCursor& cursor) : source_(source), header_(header), cursor_(cursor) {}

  Mesh read() {
    for (const Element& element : header_.elements) {
      checkRoom(element);
      if (element.name == "vertex") mesh_.positions.reserve(3 * element.count);
      if (element.name == "face") mesh_.triangles.reserve(3 * element.count);
      if (element.properties.empty()) continue;
      for (uint64_t i = 0; i < element.count; ++i) readItem(element, i);
    }
    return std::move(mesh_);
  }

 private:
  /// So that an absurd count allocates nothing.
  void checkRoom(const Element& element) const {
    size_t itemSize = 0;
    for (const Property& p : element.properties) itemSize += Source::leastSize(p.isList ? p.countType : p.type);
    if (itemSize == 0 || element.count <= source_.remaining() / itemSize) return;
    cursor_.failAt(element.line, std::to_string(element.count) + " items of the element " + element.name +
                                     " can't be in the rest of the file, which ends early or has a wrong header");
  }

  void readItem(const Element& element, uint64_t index) {
    source_.beginItem(element, index);
    double position[3] = {};
    for (const Property& p : element.properties) {
      switch (p.role) {
        case Role::x:
          position[0] = source_.number(p.type);
          break;
        case Role::y:
          position[1] = source_.number(p.type);
          break;
        case Role::z:
          position[2] = source_.number(p.type);
          break;
        case Role::corners:
          readFace(p);
          break;
        case Role::skipped:
          source_.skip(p.type, p.isList ? readLength(p) : 1);
          break;
      }
    }
    if (element.name == "vertex") mesh_.positions.insert(mesh_.positions.end(), position, position + 3);
  }

  uint64_t readLength(const Property& list) {
    const int64_t length = source_.integer(list.countType);
    if (length < 0 || uint64_t(length) > source_.remaining() / Source::leastSize(list.type)) {
      source_.fail("a list of " + std::to_string(length) + " entries can't be in the rest of the file");
    }
    return uint64_t(length);
  }

  void readFace(const Property& list) {
    const uint64_t length = readLength(list);
    if (length < 3) source_.fail("a face needs at least three vertices, found " + std::to_string(length));
    Fan fan(mesh_.triangles);
    for (uint64_t i = 0; i < length; ++i) {
      const int64_t index = source_.integer(list.type);
      if (index < 0 || uint64_t(index) >= header_.vertexCount) {
        source_.fail("there is no vertex " + std::to_string(index) + " (vertices are numbered from 0; there are " +
                     std::to_string(header_.vertexCount) + ")");
      }
      fan.add(uint32_t(index));
    }
  }

  Source source_;
  const Header& header_;
  const TextCursor& cursor_;
  Mesh mesh_;
};

}  // namespace

bool looksLikePly(std::string_view bytes) { return bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 4) == "ply\r"; }

Mesh readPly(const FileBytes& file) {
  if (!looksLikePly(file.bytes)) throw FileError(file.path + ": line 1: expected 'ply'");
  TextCursor cursor(file.path, file.bytes);
  const Header header = readHeader(cursor);
  if (header.encoding == Encoding::text) return DataReader(TextSource(cursor), header, cursor).read();
  const ByteOrder order = header.encoding == Encoding::binaryLittle ? ByteOrder::little : ByteOrder::big;
  return DataReader(BinarySource(file, file.bytes.size() - cursor.remaining(), order), header, cursor).read();
}

/// Bytes of an item, if all have as many: `corners` in each list of vertices, and no other lists.
static std::optional<size_t> itemSize(const Element& element, size_t corners) {
  size_t size = 0;
  for (const Property& p : element.properties) {
    if (p.isList && p.role != Role::corners) return std::nullopt;
    size += p.isList ? p.countType.size + corners * p.type.size : p.type.size;
  }
  return size;
}

/// Where each triangle of a file is known if all faces are triangles. If those of all parts are, the faces of each part begin there.
std::optional<Mesh> readPlyPart(const PartlyRead& file, const PartOf& part) {
  constexpr size_t kMostHeader = size_t(1) << 16;
  const std::string head = file.read(0, size_t(std::min<uint64_t>(file.size(), kMostHeader)));
  if (!looksLikePly(head) || head.find("end_header") == head.npos) return std::nullopt;
  TextCursor cursor(file.path(), head);
  const Header header = readHeader(cursor);
  const std::vector<Element>& elements = header.elements;
  if (header.encoding == Encoding::text || elements.size() != 2 || elements[0].name != "vertex" || elements[1].name != "face")
    return std::nullopt;
  const ByteOrder order = header.encoding == Encoding::binaryLittle ? ByteOrder::little : ByteOrder::big;
  uint64_t offset = head.size() - cursor.remaining();
  Mesh mesh;
  for (const Element& element : elements) {
    const std::optional<size_t> size = itemSize(element, 3);
    if (!size || *size == 0 || element.count > (file.size() - offset) / *size) return std::nullopt;
    Header some = header;
    some.elements = {element};
    some.elements[0].count = part.size(element.count);
    const std::string bytes = file.read(offset + *size * part.begin(element.count), size_t(*size * part.size(element.count)));
    const FileBytes items{file.path(), bytes};
    Mesh read = DataReader(BinarySource(items, 0, order), some, cursor).read();
    if (element.name == "vertex") mesh.positions = std::move(read.positions);
    if (element.name == "face") mesh.triangles = std::move(read.triangles);
    offset += *size * element.count;
  }
  if (mesh.triangles.size() != 3 * part.size(elements[1].count)) return std::nullopt;
  return mesh;
}

}  // namespace mandoline::detail
