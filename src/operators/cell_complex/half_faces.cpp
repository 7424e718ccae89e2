#include "operators/cell_complex/half_faces.h"

#include "base/csr.h"
#include "base/large_array.h"
#include "base/team.h"

namespace mandoline::operators {
namespace {

/// Calls f(h, cell) for all half-faces of cells: for each half-face in their order, those of a part of the cells on each thread.
template <class F>
void forHalfFaces(const CellComplex& cells, unsigned threads, const F& f) {
  detail::runOnParts(threads, threads, [&](size_t part) {
    const size_t n = cells.cellCount(), first = n * part / threads, past = n * (part + 1) / threads;
    for (uint32_t h = 0; h < cells.faceCells.size(); ++h) {
      const int32_t cell = cells.faceCells[h];
      if (cell >= 0 && size_t(cell) >= first && size_t(cell) < past) f(h, size_t(cell));
    }
  });
}

}  // namespace

void gatherHalfFaces(CellComplex& cells, unsigned threads) {
  constexpr unsigned kMost = 8;  // each reads all
  threads = std::min(threads, kMost);
  std::vector<uint32_t>& offsets = cells.cellHalfFaceOffsets;
  offsets.clear();
  detail::makeLargeOnThreads(offsets, cells.cellCount() + 1, threads);
  forHalfFaces(cells, threads, [&](uint32_t, size_t cell) { ++offsets[cell]; });
  detail::makeLargeOnThreads(cells.cellHalfFaces, detail::toOffsets(offsets), threads);
  forHalfFaces(cells, threads, [&](uint32_t h, size_t cell) { cells.cellHalfFaces[offsets[cell]++] = h; });
  detail::moveBack(offsets);
}

}  // namespace mandoline::operators
