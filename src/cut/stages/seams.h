// Seams: what bricks have in common, by the brick that owns it (brick_grid.h), and how much of the result belongs to each row of a brick.
//
// In: BrickCuts, and the runs of untouched grid cells. Out: BrickSeams. Both bricks of a seam have the same there, in the same order. Those
// of inner KeptBricks are known: see kept_seams.h.
#pragma once

#include "cut/stages/brick_cut.h"
#include "cut/stages/untouched_runs.h"

namespace mandoline::detail {

/// What a grid element on a seam holds, of one kind: a range in the lists of the brick.
struct SeamRange {
  BrickId owner;
  uint32_t key;  ///< 32 * index of the owning cell in its brick + number of the element in the cell
  Range range;
  uint32_t there = 0;  ///< of what another brick owns: where it begins in that one's list
};

struct SeamRanges {
  std::vector<SeamRange> own;     ///< of the brick, ascending by key
  std::vector<SeamRange> others;  ///< of other bricks, ascending by range

  void add(bool isOwn, const SeamRange& range) {
    if (range.range.count > 0) (isOwn ? own : others).push_back(range);
  }
};

/// How much of the result a part of a brick adds. What other processes cut adds only what ids are counted by: cells, triFaces, pieces and
/// vertices.
struct BrickCounts {
  uint32_t cells = 0, halfFaces = 0, triFaces = 0, triLoops = 0, triLoopVertices = 0, parents = 0, pieces = 0, loops = 0, loopVertices = 0,
           vertices = 0;

  void add(const BrickCounts& more);
};

/// A component of a brick and a run of untouched grid cells that lie beside each other.
struct SeamJoin {
  Slab cell;  ///< one of the run that lies beside the component, in the brick or beside it
  uint32_t component, run;
};

struct BrickSeams {
  SeamRanges triFaces, pieces, halves, vertices;
  std::vector<BrickCounts> rows;  ///< per row of the brick, of what it owns
  std::vector<SeamJoin> joins;
};

/// Calls f(row, first, past) for what a brick owns of a list: ranges of it, ascending, each in one row. `past` is the member of BrickRow
/// that says where rows end in that list.
template <class F>
void forOwn(const BrickCut& cut, uint32_t BrickRow::*past, const SeamRanges& seams, const F& f) {
  uint32_t at = 0;
  auto other = seams.others.begin();
  for (uint32_t row = 0; row < cut.rows.size(); ++row) {
    const uint32_t end = cut.rows[row].*past;
    while (at < end) {
      const bool isOtherNext = other != seams.others.end() && other->range.first < end;
      const uint32_t stop = isOtherNext ? other->range.first : end;
      if (at < stop) f(row, at, stop);
      at = isOtherNext ? (other++)->range.past() : stop;
    }
  }
}

/// All that bricks have found.
struct CutBricks {
  const Surface& surface;
  const Bricks& bricks;
  const UntouchedRuns& runs;
  const IdVector<BrickId, BrickCut>& cuts;
  const IdVector<BrickId, BrickSeams>& seams;

  /// Calls f(half, owner, other half) for what lies in the grid-faces of a brick that belong to others: what its owner, which lies below,
  /// and the brick have of it.
  template <class F>
  void forHalves(BrickId brick, const F& f) const {
    for (const SeamRange& other : seams[brick].halves.others) {
      const BoundaryHalf *below = &cuts[other.owner].boundaryHalves[other.there], *above = &cuts[brick].boundaryHalves[other.range.first];
      for (uint32_t i = 0; i < other.range.count; ++i) f(below[i], other.owner, above[i]);
    }
  }
};

/// Adds those of bricks that are not inner ones of `kept`, if there is one, to `seams`, which are those of `cut`.
void findSeams(const CutBricks& cut, const KeptBricks* kept, IdVector<BrickId, BrickSeams>& seams, Run& run);

}  // namespace mandoline::detail
