// Which cells several processes make, by the options on the command line.
#pragma once

#include <optional>

#include "cli/arguments.h"
#include "cli/cutting.h"
#include "mpi/merged_ranks.h"

namespace mandoline::cli {

/// What a RankMerging refers to.
class Merging {
 public:
  /// `groups`: those of all triangles.
  Merging(const Arguments& arguments, const TriangleGroups& groups, const RunOptions& run)
      : fraction_(mergeFraction(arguments)), coarsening_(coarsenOptions(arguments, run)) {
    if (arguments.uniteWalls) walls_.emplace(WallOptions{run, *arguments.uniteWalls, groups.triangleGroup});
  }

  /// With so many rings of ghosts.
  detail::RankMerging with(int rings) const { return {fraction_, coarsening_, rings, walls_ ? &*walls_ : nullptr}; }

 private:
  double fraction_;
  CoarsenOptions coarsening_;
  std::optional<WallOptions> walls_;
};

}  // namespace mandoline::cli
