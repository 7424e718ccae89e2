#include "cut/stages/kept_seams.h"

namespace mandoline::detail {

IdVector<BrickId, BrickSeams> keepSeams(const KeptBricks& kept, const UntouchedRuns& runs, IdVector<BrickId, BrickSeams>& before) {
  IdVector<BrickId, BrickId> now(before.size(), KeptBricks::kNone);
  for (const BrickId b : kept.before.ids()) {
    if (kept.has(b)) now[kept.before[b]] = b;
  }
  IdVector<BrickId, BrickSeams> seams(kept.before.size());
  for (const BrickId b : seams.ids()) {
    if (!kept.isInner(b)) continue;
    BrickSeams& of = seams[b] = std::move(before[kept.before[b]]);
    for (SeamRanges* ranges : {&of.triFaces, &of.pieces, &of.halves, &of.vertices}) {
      for (auto* list : {&ranges->own, &ranges->others}) {
        for (SeamRange& range : *list) range.owner = now[range.owner];
      }
    }
    // What was one run beside the brick still is: only grid cells of this brick and of those around it lie in between.
    for (SeamJoin& join : of.joins) join.run = runs.at(join.cell);
  }
  return seams;
}

}  // namespace mandoline::detail
