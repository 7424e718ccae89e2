// What a .mcm file is made of: a signature, the version, and records: one of the grid and the counts, then one of each array in the order
// of forEachArray. A record is a head, with the name before it, and a payload. All integers are lengths as of putLength, but checksums.
#pragma once

#include <algorithm>
#include <iterator>

#include "io/mcm/arrays.h"

namespace mandoline::detail {

/// As of PNG: the first byte is not ASCII, and transfer as text would change the ends of lines.
inline constexpr std::string_view kMcmSignature("\x89MCM\r\n\x1a\n", 8);
inline constexpr uint64_t kMcmVersion = 4;
inline constexpr int kChecksumBytes = 8;

struct RecordHead {
  std::string_view name;
  uint64_t length = 0;   ///< of the array, in entries
  uint64_t payload = 0;  ///< bytes that follow
  uint64_t checksum = 0;

  /// Of all of these and the payload. A change within one word of 8 bytes always shows.
  uint64_t expectedChecksum(std::string_view payloadBytes) const;
};

/// The grid and everything else that is not an array.
template <class Stream, class AnyCutMesh>
void codeHead(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh);
inline constexpr std::string_view kHeadName = "grid";

/// Arrays that are read when all others are there.
template <class AnyCutMesh, class Array>
bool isDerived(const AnyCutMesh& cutMesh, const Array& array) {
  const void* const all[] = {&cutMesh.positions, &cutMesh.vertexCell, &cutMesh.loopVertices, &cutMesh.cellHalfFaces};
  return std::find(std::begin(all), std::end(all), &array) != std::end(all);
}

/// A record's payload.
template <class Stream, class AnyCutMesh, class Array>
void codePayload(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, const ArrayInfo& info, Array& array, uint64_t length) {
  const void* const it = &array;
  if (it == &cutMesh.positions) return codePositions<Stream>(bytes, cutMesh, length);
  if (it == &cutMesh.vertexCell) return codeVertexCells<Stream>(bytes, cutMesh, length);
  if (it == &cutMesh.loopVertices) return codeLoopVertices<Stream>(bytes, cutMesh, length);
  if (it == &cutMesh.cellHalfFaces) return codeCellHalfFaces<Stream>(bytes, cutMesh, length);
  codeArray<Stream>(bytes, info, array, length);
}

}  // namespace mandoline::detail
