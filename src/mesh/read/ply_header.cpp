#include "mesh/read/ply_header.h"

namespace mandoline::detail::ply {
namespace {

constexpr TypeName kTypes[] = {
    {"char", Type::int8, 1},   {"uchar", Type::uint8, 1},   {"short", Type::int16, 2},     {"ushort", Type::uint16, 2},
    {"int", Type::int32, 4},   {"uint", Type::uint32, 4},   {"float", Type::float32, 4},   {"double", Type::float64, 8},
    {"int8", Type::int8, 1},   {"uint8", Type::uint8, 1},   {"int16", Type::int16, 2},     {"uint16", Type::uint16, 2},
    {"int32", Type::int32, 4}, {"uint32", Type::uint32, 4}, {"float32", Type::float32, 4}, {"float64", Type::float64, 8}};

bool isFloat(const TypeName& type) { return type.type == Type::float32 || type.type == Type::float64; }

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

}  // namespace

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

}  // namespace mandoline::detail::ply
