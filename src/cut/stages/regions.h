// Regions and winding numbers (not in the paper): connected components of cut-cells and untouched grid cells, joined through faces that are
// not pieces of triangles; and the winding number of each, or what there is of it, stepping by one across every tri-cut-face from an exact
// value in one place.
//
// In: all stages before. Out: Regions. Untouched grid cells are runs along x: memory by run, not by cell.
#pragma once

#include <vector>

#include "cut/stages/cut_cells.h"

namespace mandoline::detail {

struct Regions {
  std::vector<uint32_t> rowRunOffsets;    ///< per row of grid cells (k ny + j), and one more: into runs
  std::vector<int32_t> runBegin, runEnd;  ///< per run of untouched grid cells: along x, half open
  std::vector<uint32_t> runRegion;        ///< per run
  IdVector<CellId, uint32_t> cellRegion;
  uint32_t count = 0;
  bool hasWinding = false;           ///< closed and consistently oriented
  std::vector<int32_t> winding;      ///< per region, empty unless hasWinding
  std::vector<int32_t> partWinding;  ///< of parts that have it; empty if hasWinding, or if none has
  std::vector<uint8_t> parity;       ///< of parts that have parity; likewise
};

Regions findRegions(const Surface& surface, const Stencil& stencil, const CutFaces& faces, const CutCells& cells, Run& run);

}  // namespace mandoline::detail
