// Faces and cells of the result that inner KeptBricks own: they are those of the cut before, with new numbers.
//
// In: KeptBricks, and the Numbers of both cuts. Out: KeptRows, empty if the result is not written over that of the cut before.
#pragma once

#include "cut/stages/kept_vertices.h"

namespace mandoline::detail {

struct KeptRows {
  /// Rows whose things of all kinds follow each other, now and before.
  struct Run {
    BrickCounts now, before, count;
  };
  std::vector<Run> runs;  ///< ascending
  BrickCounts total, totalBefore;
  std::unique_ptr<uint32_t[]> facesNow;  ///< per face before: its number now, if it is one of kept bricks

  /// One run for each.
  KeptRuns of(uint32_t BrickCounts::*kind) const;
  /// Of tri-cut-faces, and of pieces of grid-faces, which come after all of those.
  KeptRuns ofFaces(uint32_t BrickCounts::*ofTriFaces, uint32_t BrickCounts::*ofPieces) const;
};

KeptRows findKeptRows(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut, const Numbers& numbers);

}  // namespace mandoline::detail
