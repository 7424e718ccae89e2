// PLY, in text or binary of either byte order: x, y, z of the element "vertex" and vertex_indices of the element "face". Other
// elements and properties are skipped.

#include "mesh/read/ply_header.h"
#include "mesh/read/readers.h"
#include "mesh/read/scalar.h"

namespace mandoline::detail {
namespace {

using namespace ply;

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

}  // namespace mandoline::detail
