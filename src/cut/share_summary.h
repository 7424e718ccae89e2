// What processes that make a cut together tell each other: which grid cells the surface touches, what each brick has at its boundary, how
// its components hang together, and which vertices of the surface loops have.
#pragma once

#include "cut/share_layers.h"

namespace mandoline::detail {

/// Of the bricks that are cut here. `cut` stands for the mesh, the grid and the options of all shares.
std::vector<uint32_t> summarize(const CutState& state, const ShareOf& shareOf, Fingerprint cut);

/// How much of it is of one brick.
size_t summaryBytes(const CutState& state, BrickId brick);

/// A share among others.
struct ShareContext {
  const ShareOf& shareOf;
  const ShareLayers& layers;  ///< of all shares
  Fingerprint cut;
};

/// Adds the bricks of the others, and which vertices they use. Throws Failure{badArgument} if these are not the summaries of all shares of
/// the cut (element: the first that is another).
void addSummaries(std::span<const std::vector<uint32_t>> summaries, const ShareContext& context, CutState& state);

}  // namespace mandoline::detail
