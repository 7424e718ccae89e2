// What processes that make a cut together tell each other: which grid cells the surface touches, what each brick has at its boundary, how
// its components hang together, and which vertices of the surface loops have.
#pragma once

#include "cut/share_excerpt.h"

namespace mandoline::detail {

/// A share of a cut.
struct ShareContext {
  const ShareOf& shareOf;
  Fingerprint cut;              ///< stands for the mesh, the grid and the options of all shares
  const ShareExcerpt* excerpt;  ///< null if it has the whole mesh
};

/// Of the bricks that are cut here.
std::vector<uint32_t> summarize(const CutState& state, const ShareContext& context);

/// How much of it is of one brick.
size_t summaryBytes(const CutState& state, BrickId brick);

/// Adds the bricks of the others, and numbers the vertices of the mesh and its edges that any of them uses. `layers`: of all shares. Throws
/// Failure{badArgument} if these are not the summaries of all shares of the cut (element: the first that is another).
void addSummaries(std::span<const std::vector<uint32_t>> summaries, const ShareContext& context, const ShareLayers& layers,
                  CutState& state);

}  // namespace mandoline::detail
