// Counts what each share of a cut has of it. All bricks of all shares are cut, some layers of them after the others: so memory is that of a
// few shares.
//
// Seen along y, with windows of three layers of bricks:
//
//     |  E  |  cut once more                 Each window is cut with one layer of bricks below and above it, which tell what
//     +=====+                                its own have in common with them: so counts are those of the whole. Regions of
//     |  D  |  counted                       windows that follow each other are joined in the layers that both have cut.
//     |  C  |  counted
//     |  B  |  counted
//     +=====+
//     |  A  |  cut once more
#pragma once

#include "cut/driver.h"
#include "cut/share_layers.h"

namespace mandoline::detail {

/// What a process has of its bricks.
struct BricksLoad {
  BrickCounts counts;
  uint64_t surfaceVertices = 0, made = 0;       ///< of the mesh and its edges; made ones of these
  uint64_t facesAbove = 0, seamFacesAbove = 0;  ///< in the plane above: those of its cells, and of these those that others have, too
  uint64_t summaryBytes = 0, brickBytes = 0;
  uint64_t toldBytes = 0;  ///< of what summaries tell, once it is arrays again
};

struct BricksLoads {
  std::vector<BricksLoad> ofRanks;
  uint64_t surfaceBytes = 0;  ///< of all crossings
  uint64_t seamBytes = 0;     ///< which all processes have, with untouched grid cells
  uint64_t regions = 0;
};

template <class... Arrays>
uint64_t bytesOf(const Arrays&... arrays) {
  return (0 + ... + uint64_t(arrays.size() * sizeof(*arrays.begin())));
}

/// The layers of all shares, and how much work each layer is (workOfLayers()).
struct SharesToCount {
  const ShareLayers& layers;
  uint32_t count;
  const std::vector<uint64_t>& work;
};
/// A window has so much work, or a few layers of bricks if these have more.
BricksLoads countShares(const Input& input, const SharesToCount& shares, uint64_t windowWork, const RunOptions& options);

}  // namespace mandoline::detail
