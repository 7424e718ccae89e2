// The numbers that things have in the cut-mesh. Vertices of the mesh and of its edges keep their order; all else follows the touched grid
// cells, by rows of which each brick has a part: so each row of a brick has a range of numbers.
//
// In: BrickCuts, BrickSeams. Out: Numbers. They depend on no size of bricks.
#pragma once

#include "cut/stages/seams.h"

namespace mandoline::detail {

struct Numbers {
  static constexpr uint32_t kUnused = ~0u;

  IdVector<VertexId, uint32_t> ofSurface;            ///< per vertex of the surface; kUnused if no loop has it
  uint32_t surfaceVertices = 0;                      ///< those of the mesh and its edges, which come first
  IdVector<BrickId, std::vector<uint32_t>> ofBrick;  ///< per vertex of a brick's own
  IdVector<BrickId, std::vector<uint32_t>> faces;    ///< per face of a brick
  IdVector<BrickId, std::vector<BrickCounts>> rows;  ///< per row of a brick: where its ranges begin
  BrickCounts total;

  /// Of a vertex that a brick sees.
  uint32_t vertex(BrickId brick, VertexId v) const {
    return v.number < ofSurface.size() ? ofSurface[v] : ofBrick[brick][v.number - ofSurface.size()];
  }
};

Numbers makeNumbers(const Surface& surface, const IdVector<BrickId, BrickCut>& cuts, const IdVector<BrickId, BrickSeams>& seams, Run& run);

}  // namespace mandoline::detail
