// The numbers that things have in the cut-mesh. Vertices of the mesh and of its edges keep their order; all else follows the touched grid
// cells, by rows of which each brick has a part: so each row of a brick has a range of numbers.
//
// In: BrickCuts, BrickSeams. Out: Numbers. They depend on no size of bricks.
#pragma once

#include <atomic>

#include "cut/stages/seams.h"

namespace mandoline::detail {

/// A kind of things that a brick lists by its rows: members of BrickRow, BrickSeams and BrickCounts.
struct RowKind {
  uint32_t BrickRow::*past;
  SeamRanges BrickSeams::*seams;
  uint32_t BrickCounts::*count;
};
constexpr RowKind kTriFaceRows{&BrickRow::pastTriFace, &BrickSeams::triFaces, &BrickCounts::triFaces};
constexpr RowKind kPieceRows{&BrickRow::pastPiece, &BrickSeams::pieces, &BrickCounts::pieces};
constexpr RowKind kVertexRows{&BrickRow::pastVertex, &BrickSeams::vertices, &BrickCounts::vertices};

/// Calls f(first, past, number of the first) for ranges of a kind that a brick owns. `rows`: where those of each row begin.
template <class F>
void forOwnNumbers(const BrickCut& cut, const BrickSeams& seams, const std::vector<BrickCounts>& rows, const RowKind& kind, const F& f) {
  uint32_t lastRow = ~0u, next = 0;
  forOwn(cut, kind.past, seams.*kind.seams, [&](uint32_t row, uint32_t first, uint32_t past) {
    if (row != lastRow) next = rows[row].*kind.count;
    lastRow = row;
    f(first, past, next);
    next += past - first;
  });
}

/// Per vertex of the mesh and its edges: whether some loop has it.
using UsedVertices = std::vector<std::atomic<uint8_t>>;

/// Of the loops in the bricks that are cut here.
UsedVertices findUsed(const Surface& surface, const Bricks& bricks, const IdVector<BrickId, BrickCut>& cuts, Run& run);

/// Numbers of such vertices, where several processes give them.
struct SurfaceNumbers {
  IdVector<VertexId, uint32_t> ofSurface;  ///< as that of Numbers; taken over by them
  uint32_t count = 0;                      ///< of all processes
};

struct Numbers {
  static constexpr uint32_t kUnused = ~0u;

  struct RowOfBrick {
    BrickId brick;
    uint32_t row;
  };

  IdVector<VertexId, uint32_t> ofSurface;            ///< per vertex of the surface; kUnused if no loop has it
  uint32_t surfaceVertices = 0;                      ///< those of the mesh and its edges, which come first
  IdVector<BrickId, std::vector<uint32_t>> ofBrick;  ///< per vertex of a brick's own
  IdVector<BrickId, std::vector<uint32_t>> faces;    ///< per face of a brick
  IdVector<BrickId, std::vector<BrickCounts>> rows;  ///< per row of a brick: where its ranges begin
  std::vector<RowOfBrick> order;                     ///< of all rows of bricks, as their ranges follow each other
  BrickCounts total;
  // Bricks that are cut here come one after the other: what is before them, and what is theirs.
  BrickCounts before, here;

  /// Of a vertex that a brick sees.
  uint32_t vertex(BrickId brick, VertexId v) const {
    return v.number < ofSurface.size() ? ofSurface[v] : ofBrick[brick][v.number - ofSurface.size()];
  }
  /// The place of a face among those that are made here: tri-cut-faces, then pieces of grid-faces.
  uint32_t placeHere(uint32_t face) const {
    return face < total.triFaces ? face - before.triFaces : face - total.triFaces - before.pieces + here.triFaces;
  }
};

/// Throws Failure{meshTooLarge} if vertices, faces, loop entries or half-faces are too many for their ids.
void requireFewIds(uint64_t count);

/// Of which bricks what they own, and what others own, gets numbers by itself. The rows of all do.
struct BricksToNumber {
  std::vector<uint32_t> own, others;
};

/// `used`: by all bricks. `ofAll`: null where no other process cuts.
Numbers makeNumbers(const CutBricks& cut, const BricksToNumber& bricks, const UsedVertices& used, SurfaceNumbers* ofAll, Run& run);

}  // namespace mandoline::detail
