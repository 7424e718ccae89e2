#include "cut/stages/kept_seams.h"

namespace mandoline::detail {

namespace {

void renumber(BrickSeams& seams, const IdVector<BrickId, BrickId>& now) {
  for (SeamRanges* ranges : {&seams.triFaces, &seams.pieces, &seams.halves, &seams.vertices}) {
    for (auto* list : {&ranges->own, &ranges->others}) {
      for (SeamRange& range : *list) range.owner = now[range.owner];
    }
  }
}

}  // namespace

IdVector<BrickId, BrickSeams> keepSeams(const KeptBricks& kept, const UntouchedRuns& runs, IdVector<BrickId, BrickSeams>& before) {
  IdVector<BrickId, BrickId> now(before.size(), KeptBricks::kNone);
  bool haveSameIds = true;
  for (const BrickId b : kept.before.ids()) {
    if (!kept.has(b)) continue;
    now[kept.before[b]] = b;
    haveSameIds &= kept.before[b] == b;
  }
  IdVector<BrickId, BrickSeams> seams(kept.before.size());
  for (const BrickId b : seams.ids()) {
    if (!kept.isInner(b)) continue;
    BrickSeams& of = seams[b] = std::move(before[kept.before[b]]);
    if (!haveSameIds) renumber(of, now);
    // What was one run beside the brick still is: only grid cells of this brick and of those around it lie in between.
    for (SeamJoin& join : of.joins) join.run = runs.at(join.cell);
  }
  return seams;
}

}  // namespace mandoline::detail
