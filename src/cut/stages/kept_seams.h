// Seams of inner KeptBricks: they are those of the cut before, with new ids of bricks and of runs of untouched grid cells.
//
// In: KeptBricks, Bricks and UntouchedRuns now; the BrickSeams before. Out: BrickSeams, empty for all other bricks.
#pragma once

#include "cut/stages/seams.h"

namespace mandoline::detail {

/// Moves them out of `before`.
IdVector<BrickId, BrickSeams> keepSeams(const KeptBricks& kept, const UntouchedRuns& runs, IdVector<BrickId, BrickSeams>& before);

}  // namespace mandoline::detail
