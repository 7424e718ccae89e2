#include "io/selection.h"

#include "operators/require_cut_mesh.h"

namespace mandoline::detail {

void requireAll(const WriteOptions& options) {
  if (options.regions.empty() && options.untouched) return;
  operators::refuse("Files of this format always have everything: leave out regions and untouched.");
}

Selection::Selection(const CutMesh& cutMesh, const WriteOptions& options) : cutMesh_(cutMesh), options_(options) {
  operators::requireNotEmpty(cutMesh);
  if (!allRegions() && options.regions.size() != cutMesh.regionCount) {
    operators::refuse("regions must have one flag for each of the cut-mesh's " + std::to_string(cutMesh.regionCount) +
                      " regions, but has " + std::to_string(options.regions.size()) + ".");
  }
}

}  // namespace mandoline::detail
