// Which blocks of the smallest cells are cut as one.
#pragma once

#include "mandoline/refine.h"
#include "operators/coarsen/block_tree.h"

namespace mandoline::refining {

using operators::Block;
using operators::Blocks;

/// How often grid cells are divided at most.
int mostLevels(const RefineOptions& options);

/// All blocks, where level 0 is that of the smallest cells; cellRegion is left empty. `planes`: those of the smallest cells.
OctreeCells findLeaves(const MeshView& mesh, const CutMesh& cutMesh, const std::array<std::vector<double>, 3>& planes,
                       const RefineOptions& options, detail::Monitor& monitor);

}  // namespace mandoline::refining
