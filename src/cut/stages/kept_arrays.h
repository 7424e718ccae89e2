// Arrays of the result that are written over those of the cut before: what is kept in them is brought to where it is now.
//
// In: KeptBricks, KeptVertices, and the Numbers of both cuts, of surfaces whose triangles don't meet; the arrays before. Out: the arrays,
// in which inner KeptBricks have what they own, and vertices are that are kept.
#pragma once

#include "cut/stages/kept_rows.h"
#include "cut/stages/output_part.h"

namespace mandoline::detail {

class ArraysBefore final : public KeptArrays {
 public:
  BricksToNumber bricksToNumber(const CutState& state) const override;
  void begin(const VerticesBefore& before, const CutState& state, const KeptRuns& vertices) override;
  void placeCells(const Arrays& arrays) const override;
  void placeFaces(const Arrays& arrays) const override;
  void placeVertices(const Arrays& arrays, size_t count) const override;

 private:
  KeptRuns vertices_;
  KeptRows rows_;
};

}  // namespace mandoline::detail
