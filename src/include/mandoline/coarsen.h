// Untouched grid cells merged into octree cells, away from the surface (paper, 5.3).
#pragma once

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

struct CoarsenOptions : RunOptions {
  int maxLevel = 24;          ///< octree cells have at most 2^maxLevel grid cells on a side; 0 merges nothing
  int fineLayers = 1;         ///< how many layers of grid cells around each cut one, diagonally too, are not merged
  bool balanceEdges = false;  ///< whether cells that share only an edge also differ by at most one level
  /// Least layers of cells of each level above 0, diagonally too, between smaller and larger ones; of level 1, which are the most cells,
  /// a quarter as many do, but two where there are so many. kGraded: a twelfth of the grid cells along the longest side, but at least one,
  /// so that all cells shrink as those of the grid do.
  int layersPerLevel = kGraded;

  static constexpr int kGraded = -1;
};

/// The cells that replace the untouched grid cells. One of level L is a block of 2^L grid cells on a side that begins at multiples of 2^L,
/// or the part of it inside the grid. Cells that share a part of a face differ by at most one level, a cut grid cell counting as one
/// of level 0; there are as few cells as that allows. In Morton order: x changes fastest, then y, then z, at each level.
struct OctreeCells {
  std::array<int32_t, 3> gridCells{};  ///< number of grid cells per axis
  std::vector<int32_t> cellCorner;     ///< 3 per octree cell: its lowest grid cell
  std::vector<uint8_t> cellLevel;      ///< per octree cell
  std::vector<uint32_t> cellRegion;    ///< per octree cell: region of the cut-mesh
  Fingerprint madeFrom;                ///< of the cut-mesh
  Fingerprint fingerprint;             ///< of the octree cells

  size_t cellCount() const { return cellLevel.size(); }
  std::array<int32_t, 3> corner(size_t cell) const { return {cellCorner[3 * cell], cellCorner[3 * cell + 1], cellCorner[3 * cell + 2]}; }
  /// One past its last grid cell, per axis.
  std::array<int32_t, 3> end(size_t cell) const {
    std::array<int32_t, 3> end = corner(cell);
    for (size_t d = 0; d < 3; ++d) end[d] = end[d] < gridCells[d] - (1 << cellLevel[cell]) ? end[d] + (1 << cellLevel[cell]) : gridCells[d];
    return end;
  }
  /// The octree cell that holds a grid cell, or -1 if that is cut or lies outside the grid. Takes logarithmic time.
  int64_t find(int64_t i, int64_t j, int64_t k) const;

  static void fields(auto& self, const auto& f) {
    f("gridCells", self.gridCells);
    f("cellCorner", self.cellCorner);
    f("cellLevel", self.cellLevel);
    f("cellRegion", self.cellRegion);
    f("madeFrom", self.madeFrom);
    f("fingerprint", self.fingerprint);
  }
};

/// Takes time and memory in proportion to the numbers of cut-cells and octree cells. The defaults are for solvers; without fineLayers and
/// layersPerLevel there are the fewest cells. Throws CallError if an option is negative, but for kGraded (badOption), or if cancelled.
OctreeCells coarsen(const CutMesh& cutMesh, const CoarsenOptions& options = {});

}  // namespace mandoline
