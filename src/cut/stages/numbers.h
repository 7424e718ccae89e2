// The numbers that things have in the cut-mesh. They follow the mesh (vertices on it, tri-cut-faces), or the touched grid cells (all else):
// by rows of grid cells, of which each brick has a part, so that each row of a brick has a range of numbers.
//
// In: BrickCuts. Out: Numbers. They depend on no size of bricks.
#pragma once

#include "cut/stages/brick_cut.h"

namespace mandoline::detail {

struct Numbers {
  static constexpr uint32_t kUnused = ~0u;

  IdVector<VertexId, uint32_t> vertices;  ///< kUnused if no loop has it
  uint32_t vertexCount = 0;
  IdVector<BrickId, std::vector<BrickCounts>> rows;  ///< per row of a brick: where its ranges begin
  IdVector<BrickId, std::vector<uint32_t>> pieces;   ///< per piece of a brick: its number among the pieces of all
  BrickCounts total;
};

Numbers makeNumbers(const CutSurface& surface, const IdVector<BrickId, BrickCut>& cuts);

}  // namespace mandoline::detail
