// Which parts of a cut-mesh are written.
#pragma once

#include "mandoline/io.h"

namespace mandoline::detail {

/// Throws CallError for options that select parts, before a file is written that always has everything.
void requireAll(const WriteOptions& options);

class Selection {
 public:
  /// Throws CallError for options that do not fit the cut-mesh.
  Selection(const CutMesh& cutMesh, const WriteOptions& options);

  bool all() const { return options_.regions.empty() && options_.untouched && !options_.simpleCells; }
  bool allRegions() const { return options_.regions.empty(); }
  bool has(uint32_t region) const { return options_.hasRegion(region); }
  bool simpleCells() const { return options_.simpleCells; }
  bool hasCutCell(size_t cell) const { return has(cutMesh_.cellRegion[cell]); }

  /// Calls visit(begin, end, region) for the runs of untouched cells to be written in a row of grid cells.
  template <class Visit>
  void forEachRun(size_t row, const Visit& visit) const {
    if (!options_.untouched || row + 1 >= cutMesh_.rowRunOffsets.size()) return;
    for (uint32_t run = cutMesh_.rowRunOffsets[row]; run < cutMesh_.rowRunOffsets[row + 1]; ++run) {
      if (has(cutMesh_.runRegion[run])) visit(cutMesh_.runBegin[run], cutMesh_.runEnd[run], cutMesh_.runRegion[run]);
    }
  }

  const CutMesh& cutMesh() const { return cutMesh_; }

 private:
  const CutMesh& cutMesh_;
  const WriteOptions& options_;
};

}  // namespace mandoline::detail
