// Which grid cells a plane cuts.
#pragma once

#include "mandoline/cut_mesh.h"
#include "operators/slice/plane_stack.h"

namespace mandoline::operators {

using GridCell = std::array<int32_t, 3>;

/// Grid cells begin .. end - 1 along each axis.
struct CellRange {
  int32_t begin, end;
};
using CellBox = std::array<CellRange, 3>;

class CutBoxes {
 public:
  CutBoxes(const CutMesh& cutMesh, const ScaledGrid& grid) : cutMesh_(cutMesh), grid_(grid) {}

  /// f(begin, end, j, k, region) for the untouched grid cells that have corners on both sides of the plane, by rows.
  template <class F>
  void forUntouched(const CuttingPlane& plane, const F& f) const {
    CellBox box;
    for (size_t d = 0; d < 3; ++d) box[d] = {0, int32_t(grid_.planes[d].size()) - 1};
    const CellRange layers = cutAlong(plane, 2, box);
    for (int32_t k = layers.begin; k < layers.end; ++k) {
      box[2] = {k, k + 1};
      box[1] = {0, int32_t(grid_.planes[1].size()) - 1};
      const CellRange rows = cutAlong(plane, 1, box);
      for (int32_t j = rows.begin; j < rows.end; ++j) {
        box[1] = {j, j + 1};
        forRuns(cutAlong(plane, 0, box), j, k, f);
      }
    }
  }

 private:
  /// Within a box of grid cells, the slabs across an axis that have corners on both sides.
  CellRange cutAlong(const CuttingPlane& plane, int axis, const CellBox& box) const;

  template <class F>
  void forRuns(const CellRange& cells, int32_t j, int32_t k, const F& f) const {
    const size_t row = size_t(k) * size_t(cutMesh_.grid.cells(1)) + size_t(j);
    for (uint32_t r = cutMesh_.rowRunOffsets[row]; r < cutMesh_.rowRunOffsets[row + 1]; ++r) {
      const int32_t begin = std::max(cells.begin, cutMesh_.runBegin[r]), end = std::min(cells.end, cutMesh_.runEnd[r]);
      if (begin < end) f(begin, end, j, k, cutMesh_.runRegion[r]);
    }
  }

  const CutMesh& cutMesh_;
  const ScaledGrid& grid_;
};

}  // namespace mandoline::operators
