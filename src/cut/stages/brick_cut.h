// What one brick adds to the result: the stages from the stencil to the cut-cells on its grid cells, and what other bricks need to know of
// it.
//
// In: CutSurface, and the runs of untouched grid cells. Out: BrickCut. Bricks are cut in any order, on any number of threads.
#pragma once

#include "cut/stages/cut_cells.h"
#include "cut/stages/untouched_runs.h"
#include "cut/stages/winding_steps.h"

namespace mandoline::detail {

/// How much of the result a part of a brick adds.
struct BrickCounts {
  uint32_t cells = 0, halfFaces = 0, pieces = 0, loops = 0, loopVertices = 0, gridVertices = 0;

  void add(const BrickCounts& more) {
    cells += more.cells;
    halfFaces += more.halfFaces;
    pieces += more.pieces;
    loops += more.loops;
    loopVertices += more.loopVertices;
    gridVertices += more.gridVertices;
  }
};

/// A row of grid cells along x, as far as it lies in the brick.
struct BrickRow {
  uint32_t row;                                  ///< k ny + j
  uint32_t pastCell, pastPiece, pastGridVertex;  ///< where what its cells have first ends, in the brick
  BrickCounts counts;                            ///< of what belongs to its cells
};

/// A grid element on a seam, by the cell that it belongs to: the brick has that cell, or another one.
struct SeamPlace {
  BrickId owner;
  uint32_t key;  ///< 8 * index of the cell in its brick + number of the element in the cell
};

/// Something in a grid-face on a seam, as the cell below sees it, and what lies on the brick's side of it.
struct SeamHalf {
  HalfFace halfFace;
  uint32_t component;
};

/// What lies in a grid-face on a seam; both bricks have the same in the same order.
struct SeamFace {
  SeamPlace place;
  uint32_t firstPiece, pieces;  ///< of the brick
  uint32_t firstHalf, halves;   ///< among its seamHalves
};

struct SeamVertex {
  SeamPlace place;
  VertexId vertex;
};

/// Components of cut-cells are joined through pieces of grid-faces inside of the brick.
struct BrickCut {
  Csr<HalfFace, CellId> halfFaces;        ///< faces: all tri-cut-faces, and then the pieces of this brick
  IdVector<CellId, uint32_t> gridCells;   ///< in the brick's box, ascending
  IdVector<CellId, uint32_t> components;  ///< numbered by their first cells
  uint32_t componentCount = 0;

  // Pieces of grid-faces, by the first cell of the brick that has them.
  Csr<VertexId> loops;
  std::vector<uint32_t> faceLoopOffsets{0};
  std::vector<Slab> gridFaces;

  std::vector<BrickRow> rows;  ///< ascending, those with touched cells
  std::vector<SeamHalf> seamHalves;
  std::vector<SeamFace> ownSeams, otherSeams;  ///< grid-faces on seams that belong to this brick, or to another one; ascending
  std::vector<SeamVertex> ownSeamVertices, otherSeamVertices;  ///< grid vertices, likewise

  std::vector<std::array<uint32_t, 2>> joins;  ///< component, run: what lies beside each other
  std::vector<WindingStep> steps;              ///< between components
  std::optional<uint32_t> componentAtCorner;   ///< that of the point in windingAtLowestCorner(), where the brick has that

  std::span<const SeamHalf> halvesOf(const SeamFace& seam) const { return {seamHalves.data() + seam.firstHalf, seam.halves}; }
};

/// Calls f(row, begin, end) for the pieces that belong to the brick: ranges of them, ascending, each in one of its rows.
template <class F>
void forOwnPieces(const BrickCut& cut, const F& f) {
  uint32_t piece = 0;
  auto seam = cut.otherSeams.begin();
  for (uint32_t row = 0; row < cut.rows.size(); ++row) {
    const uint32_t past = cut.rows[row].pastPiece;
    while (piece < past) {
      const bool isSeamNext = seam != cut.otherSeams.end() && seam->firstPiece < past;
      const uint32_t end = isSeamNext ? seam->firstPiece : past;
      if (piece < end) f(row, piece, end);
      piece = isSeamNext ? end + (seam++)->pieces : end;
    }
  }
}

/// What has this key, among those of its owner.
template <class Seam>
const Seam& seamAt(const std::vector<Seam>& own, uint32_t key) {
  return *std::lower_bound(own.begin(), own.end(), key, [](const Seam& seam, uint32_t k) { return seam.place.key < k; });
}

/// Calls f(half, owner, other half) for what lies in the grid-faces of a brick that belong to others: what its owner, which lies below, and
/// the brick have of it.
template <class F>
void forSeams(const IdVector<BrickId, BrickCut>& cuts, BrickId brick, const F& f) {
  for (const SeamFace& seam : cuts[brick].otherSeams) {
    const BrickCut& owner = cuts[seam.place.owner];
    const auto below = owner.halvesOf(seamAt(owner.ownSeams, seam.place.key)), above = cuts[brick].halvesOf(seam);
    for (size_t i = 0; i < above.size(); ++i) f(below[i], seam.place.owner, above[i]);
  }
}

/// Cuts all bricks. Grid vertices are written to `vertices`, which are those of the surface.
IdVector<BrickId, BrickCut> cutBricks(const CutSurface& surface, CutVertices& vertices, const UntouchedRuns& runs, Run& run);

}  // namespace mandoline::detail
