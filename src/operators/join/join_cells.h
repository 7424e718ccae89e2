// Cut-cells of pieces that follow each other, put together.
#pragma once

#include "base/shared.h"
#include "mandoline/rank_piece.h"

namespace mandoline::operators {

/// Some cut-cells of a piece.
struct PieceCells {
  const RankPiece& piece;
  IdRange range;
};

/// These cells, with their faces and vertices, each once. Ids in the whole are told; made vertices, runs, regions, ranks and seams are not.
MANDOLINE_SHARED RankPiece joinCells(std::span<const PieceCells> cells);

}  // namespace mandoline::operators
