#include <array>

#include "io/mcm/arrays.h"

namespace mandoline::detail {
namespace {

constexpr int64_t kNoCell = -1;

/// Per half-face its cell, or kNoCell; if it has several, any of them: the differences then record the others.
std::vector<int64_t> cellsOf(const CutMesh& cutMesh) {
  std::vector<int64_t> cells(2 * cutMesh.faceTriangle.size(), kNoCell);
  for (size_t c = 0; c + 1 < cutMesh.cellHalfFaceOffsets.size(); ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) cells[h] = int64_t(c);
  }
  return cells;
}

/// What the array is if each cell has its half-faces in the cutter's order: those of triangles first, then those of the grid-faces below
/// and above it along x, y and z; each with ascending ids. Half-faces without a place in their cell are left out.
std::vector<uint32_t> inOrder(const CutMesh& cutMesh, const std::vector<int64_t>& cells) {
  const std::vector<uint32_t>& offsets = cutMesh.cellHalfFaceOffsets;
  std::array<std::vector<uint32_t>, 7> groups;
  for (uint32_t h = 0; h < cells.size(); ++h) {
    const int8_t axis = cutMesh.faceAxis[h / 2];
    const bool ofGrid = cutMesh.faceTriangle[h / 2] < 0 && axis >= 0 && axis < 3;
    if (cells[h] != kNoCell) groups[ofGrid ? 1 + 2 * size_t(axis) + (h % 2 == 0) : 0].push_back(h);
  }
  std::vector<uint32_t> ordered(cutMesh.cellHalfFaces.size(), 0), next(offsets.begin(), offsets.end());
  for (const std::vector<uint32_t>& group : groups) {
    for (const uint32_t h : group) {
      const size_t c = size_t(cells[h]);
      if (next[c] < offsets[c + 1]) ordered[next[c]++] = h;
    }
  }
  return ordered;
}

}  // namespace

template <class Stream, class AnyCutMesh>
void codeCellHalfFaces(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, uint64_t length) {
  constexpr bool kIsRead = !std::is_const_v<AnyCutMesh>;
  const int64_t cellCount = int64_t(cutMesh.cellHalfFaceOffsets.size()) - 1;
  requireOffsets(cutMesh.cellHalfFaceOffsets, length);
  if (cutMesh.faceAxis.size() != cutMesh.faceTriangle.size()) throw Damaged{"does not fit the arrays of faces"};
  Stream sides(bytes), order(bytes);
  sides.expect(2 * cutMesh.faceTriangle.size());
  order.expect(length);
  setLength(cutMesh.cellHalfFaces, length);
  std::vector<int64_t> cells(2 * cutMesh.faceTriangle.size());
  if constexpr (!kIsRead) cells = cellsOf(cutMesh);
  for (size_t h = 0; h < cells.size(); ++h) {
    cells[h] = codeDifference(sides, cells[h], h == 0 ? 0 : cells[h % 2 ? h - 1 : h - 2]);
    if (cells[h] < kNoCell || cells[h] >= cellCount) throw Damaged{"names a cell that does not exist"};
  }
  const std::vector<uint32_t> ordered = inOrder(cutMesh, cells);
  for (size_t i = 0; i < ordered.size(); ++i) codeEntry(order, cutMesh.cellHalfFaces[i], ordered[i]);
  sides.finish();
  order.finish();
}

template void codeCellHalfFaces<WrittenStream>(std::string& bytes, const CutMesh& cutMesh, uint64_t length);
template void codeCellHalfFaces<ReadStream>(std::string_view& bytes, CutMesh& cutMesh, uint64_t length);

}  // namespace mandoline::detail
