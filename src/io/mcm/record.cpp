#include "io/mcm/record.h"

#include "base/mix.h"
#include "base/plain_arithmetic.h"
#include "mesh/read/scalar.h"

namespace mandoline::detail {
namespace {

uint64_t checksum(std::string_view bytes, uint64_t sum) {
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) sum = mixed(sum, loadScalar<uint64_t>(bytes.data(), ByteOrder::little));
  uint64_t rest = 0;
  for (size_t i = 0; i < bytes.size(); ++i) rest |= uint64_t(uint8_t(bytes[i])) << 8 * i;
  return mixed(sum, rest);
}

template <class Stream, class Planes>
void codePlanes(Stream& stream, Planes& planes, double origin, double spacing) {
  const uint64_t count = uint64_t(stream.code(int64_t(planes.size())));
  stream.expect(count);
  setLength(planes, count);
  for (size_t i = 0; i < planes.size(); ++i) {
    const double guess = spacing > 0 ? origin + spacing * double(i) : i < 2 ? 0 : planes[i - 1] + (planes[i - 1] - planes[i - 2]);
    codeEntry(stream, planes[i], toInteger(guess));
  }
}

}  // namespace

uint64_t RecordHead::expectedChecksum(std::string_view payloadBytes) const {
  return detail::checksum(payloadBytes, mixed(detail::checksum(name, length), payload));
}

template <class Stream, class AnyCutMesh>
void codeHead(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh) {
  Stream stream(bytes);
  auto& grid = cutMesh.grid;
  const auto code = [&](auto& entry) { codeEntry(stream, entry, 0); };
  code(grid.uniform);
  for (size_t d = 0; d < 3; ++d) {
    code(grid.origin[d]);
    code(grid.spacing[d]);
  }
  code(cutMesh.regionCount);
  code(cutMesh.hasWinding);
  code(cutMesh.triangleCount);
  code(cutMesh.snapTolerance);
  code(cutMesh.madeFrom.value);
  code(cutMesh.fingerprint.value);
  for (size_t d = 0; d < 3; ++d) codePlanes(stream, grid.planes[d], grid.origin[d], grid.spacing[d]);
  stream.finish();
}

template void codeHead<WrittenStream>(std::string& bytes, const CutMesh& cutMesh);
template void codeHead<ReadStream>(std::string_view& bytes, CutMesh& cutMesh);

}  // namespace mandoline::detail
