#include "physics/cell_edges.h"

#include <algorithm>

#include "base/large_array.h"
#include "base/sort.h"
#include "physics/node_loops.h"
#include "physics/rows_of.h"

namespace mandoline::physics {

detail::Csr<uint32_t> cellEdges(const CellComplex& cells, const DualEdges& dual, unsigned threads) {
  constexpr uint32_t kNone = ~uint32_t(0);
  std::vector<uint32_t> edgeOf;
  detail::makeLargeOnThreads(edgeOf, cells.faceCount(), threads);
  std::fill(edgeOf.begin(), edgeOf.end(), kNone);
  forBlocks(dual.edges.size(), threads, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      for (const uint32_t f : dual.faces[e]) edgeOf[f] = uint32_t(e);
    }
  });
  return rowsOf(cells.cellCount(), threads, [&](size_t c, std::vector<uint32_t>& row) {
    for (const uint32_t h : cells.halfFaces(c)) {
      if (edgeOf[h / 2] != kNone) row.push_back(edgeOf[h / 2]);
    }
    detail::sortUnique(row);
  });
}

}  // namespace mandoline::physics
