// Regions divided at grid-faces, by labels of their cells.
#pragma once

#include "mandoline/coarsen.h"

namespace mandoline::operators {

/// Which region each cut-cell and octree cell comes to lie in.
struct DividedRegions {
  uint32_t count = 0;
  std::vector<uint32_t> cellRegion;    ///< per cut-cell
  std::vector<uint32_t> octreeRegion;  ///< per cell of coarsen(cutMesh)
  // Runs of untouched grid cells, as in CutMesh.
  std::vector<uint32_t> rowRunOffsets, runRegion;
  std::vector<int32_t> runBegin, runEnd;
};

/// Connected sets of cut-cells and octree cells with one label, joined through faces that are not pieces of triangles, in the order in
/// which their first grid cell comes. `labels`: per cut-cell, then per octree cell; `owners`: of half-faces.
DividedRegions divideRegions(const CutMesh& cutMesh, const OctreeCells& octree, const std::vector<int32_t>& owners,
                             const std::vector<int32_t>& labels);

}  // namespace mandoline::operators
