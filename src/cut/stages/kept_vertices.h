// Vertices of the result that lie where they did, with their positions in the cut before.
//
// In: KeptBricks, and the Numbers of both cuts. Out: KeptVertices: those on grid elements that only kept bricks have.
#pragma once

#include "cut/stages/kept_runs.h"
#include "cut/stages/numbers.h"

namespace mandoline::detail {

struct KeptVertices : KeptRuns {
  std::span<const double> positions;  ///< before
  bool areInPlace = false;            ///< whether the result is written over that before
};

/// Of the cut before: what is left of it once bricks and seams are kept.
struct VerticesBefore {
  const Bricks& bricks;
  const IdVector<BrickId, BrickSeams>& seams;
  const Numbers& numbers;
};

/// Without positions.
KeptRuns findKeptVertices(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut, const Numbers& numbers);

}  // namespace mandoline::detail
