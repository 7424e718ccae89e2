// Binary PLY read in pieces, where all records of an element have one size: faces are triangles, and there are no other lists.
#include "mesh/read/ply_header.h"
#include "mesh/read/readers.h"
#include "mesh/read/scalar.h"

namespace mandoline::detail {
namespace {

using namespace ply;

/// Calls f(0) with a zero of the type.
template <class F>
void withType(Type type, const F& f) {
  switch (type) {
    case Type::int8:
      return f(int8_t(0));
    case Type::uint8:
      return f(uint8_t(0));
    case Type::int16:
      return f(int16_t(0));
    case Type::uint16:
      return f(uint16_t(0));
    case Type::int32:
      return f(int32_t(0));
    case Type::uint32:
      return f(uint32_t(0));
    case Type::float32:
      return f(float(0));
    case Type::float64:
      return f(double(0));
  }
}

/// Numbers at the same place of each record.
struct Field {
  size_t offset = 0;
  Type type = Type::uint8;
};

/// The records of an element.
struct Records {
  uint64_t count = 0, offset = 0;
  size_t size = 0;
  Field coordinates[3];   // of a vertex
  Field length, corners;  // of a face

  /// Nothing if records differ in size.
  static std::optional<Records> of(const Element& element, uint64_t offset) {
    Records records;
    records.count = element.count;
    records.offset = offset;
    for (const Property& p : element.properties) {
      if (p.isList && p.role != Role::corners) return std::nullopt;
      if (p.role == Role::x || p.role == Role::y || p.role == Role::z)
        records.coordinates[size_t(p.role) - size_t(Role::x)] = {records.size, p.type.type};
      if (p.isList) {
        records.length = {records.size, p.countType.type};
        records.corners = {records.size + p.countType.size, p.type.type};
      }
      records.size += p.isList ? p.countType.size + 3 * p.type.size : p.type.size;
    }
    return records;
  }
};

class PlySource : public MeshSource {
 public:
  PlySource(PartlyRead file, ByteOrder order, const Records& vertexRecords, const Records& faceRecords)
      : file_(std::move(file)), order_(order), vertices_(vertexRecords), faces_(faceRecords) {
    vertices = vertices_.count;
    triangles = faces_.count;
  }

  void readPositions(uint64_t first, std::span<double> positions) const override {
    const std::string bytes = read(vertices_, first, positions.size() / 3);
    for (size_t d = 0; d < 3; ++d) {
      forNumbers(bytes, vertices_, vertices_.coordinates[d], [&](size_t i, auto number) { positions[3 * i + d] = double(number); });
    }
  }

  void readCorners(uint64_t first, std::span<uint32_t> corners) const override {
    const std::string bytes = read(faces_, first, corners.size() / 3);
    bool areFit = true;
    forNumbers(bytes, faces_, faces_.length, [&](size_t, auto length) { areFit &= int64_t(length) == 3; });
    for (size_t i = 0; i < 3; ++i) {
      Field field = faces_.corners;
      withType(field.type, [&](auto zero) { field.offset += i * sizeof zero; });
      forNumbers(bytes, faces_, field, [&](size_t t, auto index) {
        const int64_t v = int64_t(index);
        areFit &= v >= 0 && uint64_t(v) < vertices;
        corners[3 * t + i] = uint32_t(v);
      });
    }
    if (!areFit) throw FileError(file_.path() + ": not all faces are triangles of vertices that there are");
  }

 private:
  std::string read(const Records& records, uint64_t first, size_t count) const {
    return file_.read(records.offset + records.size * first, records.size * count);
  }

  template <class F>
  void forNumbers(const std::string& bytes, const Records& records, const Field& field, const F& f) const {
    withType(field.type, [&, order = order_](auto zero) {
      const char* at = bytes.data() + field.offset;
      for (size_t i = 0; i < bytes.size() / records.size; ++i, at += records.size) f(i, loadScalar<decltype(zero)>(at, order));
    });
  }

  const PartlyRead file_;
  const ByteOrder order_;
  const Records vertices_, faces_;
};

/// The beginning of a file with all of its header and what ends its last line, which may be two characters; or nothing if that is not
/// found.
std::string headOf(const PartlyRead& file) {
  constexpr uint64_t kLeast = uint64_t(1) << 16, kMost = uint64_t(1) << 24;
  for (uint64_t size = kLeast; size <= kMost; size *= 16) {
    std::string head = file.read(0, size_t(std::min(file.size(), size)));
    const size_t lineEnd = head.find_first_of("\r\n", head.find("end_header"));
    const bool isComplete = lineEnd != head.npos && lineEnd + 1 < head.size();
    if (isComplete || head.size() == file.size()) return head;
  }
  return {};
}

}  // namespace

std::shared_ptr<const MeshSource> openPly(PartlyRead file) {
  const std::string head = headOf(file);
  if (!looksLikePly(head) || head.find("end_header") == head.npos) return nullptr;
  TextCursor cursor(file.path(), head);
  const Header header = readHeader(cursor);
  const std::vector<Element>& elements = header.elements;
  if (header.encoding == Encoding::text || elements.size() != 2 || elements[0].name != "vertex" || elements[1].name != "face")
    return nullptr;
  std::optional<Records> records[2];
  uint64_t offset = head.size() - cursor.remaining();
  for (size_t i = 0; i < 2; ++i) {
    records[i] = Records::of(elements[i], offset);
    if (!records[i] || records[i]->count > (file.size() - offset) / records[i]->size) return nullptr;
    offset += records[i]->size * records[i]->count;
  }
  const ByteOrder order = header.encoding == Encoding::binaryLittle ? ByteOrder::little : ByteOrder::big;
  return std::make_shared<const PlySource>(std::move(file), order, *records[0], *records[1]);
}

}  // namespace mandoline::detail
