// The arrays of a cut-mesh as bytes. Each entry is predicted from those before it, and the difference takes few bits. Where they are
// read, `length` is the length that the array gets; where they are written, the one that it has.
#pragma once

#include "io/mcm/streams.h"
#include "mandoline/cut_mesh.h"

namespace mandoline::detail {

/// An array as it comes: entries are predicted by those of the element before.
template <class Stream, class Array>
void codeArray(typename Stream::Bytes& bytes, const ArrayInfo& info, Array& array, uint64_t length) {
  using Number = typename std::remove_const_t<Array>::value_type;
  Stream stream(bytes);
  stream.expect(length);
  setLength(array, length);
  const bool isKind = sizeof(Number) == 1;  // that of the element before tells little
  const size_t items = size_t(info.items);
  for (size_t i = 0; i < array.size(); ++i) codeEntry(stream, array[i], i < items || isKind ? 0 : toInteger(array[i - items]));
  stream.finish();
}

// Arrays that others tell much about. Those must be there already; throws Damaged if the length does not fit them.

/// positions, from the grid and the arrays of vertices but vertexCell. Of a coordinate on a plane the plane is written; those of a vertex
/// on a tri-edge follow from its ends, and only rounding, if any, is left to write. Others often have few digits.
template <class Stream, class AnyCutMesh>
void codePositions(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, uint64_t length);

/// vertexCell, from the positions and the grid.
template <class Stream, class AnyCutMesh>
void codeVertexCells(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, uint64_t length);

/// loopVertices, from loopOffsets. After a vertex often comes one that some loop before had beside it.
template <class Stream, class AnyCutMesh>
void codeLoopVertices(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, uint64_t length);

/// cellHalfFaces, from cellHalfFaceOffsets and faces: the cells of each face are written, and where the order in a cell is another than the
/// cutter's.
template <class Stream, class AnyCutMesh>
void codeCellHalfFaces(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, uint64_t length);

/// Throws Damaged unless the offsets start with 0, ascend and end with `end`.
void requireOffsets(const std::vector<uint32_t>& offsets, uint64_t end);

}  // namespace mandoline::detail
