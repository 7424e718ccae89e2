// Which small cells of the whole merge with neighbours, decided by the first process.
#pragma once

#include "mandoline/merge.h"
#include "mpi/communicator.h"

namespace mandoline {
struct CutMesh;
struct RankComplex;
}  // namespace mandoline

namespace mandoline::detail {

/// A cell that is not the first of those that it becomes one with.
struct Absorbed {
  uint64_t cell, first;
  int64_t layer;  ///< of the first one
};

/// Ascending. `complex` has at least two rings of ghosts. Collective.
///
/// The first process is told of cut-cells, and of untouched grid cells and octree cells up to the second one from a cut-cell. Untouched
/// ones never are small, nor move from one merged cell to another, and no merged cell has two of them. So only those beside a cut-cell get
/// members. The decision reads centroids of cells beside merged ones, so also of those beside these; and it reads nothing of other cells.
/// That has nothing to do with the sizes of cells.
std::vector<Absorbed> absorbedCells(Communicator& comm, const CutMesh& common, const RankComplex& complex, const MergeOptions& options);

}  // namespace mandoline::detail
