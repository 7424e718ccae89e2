// Volumes of regions.
#include "operators/measure/region_sums.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace detail {

void addCutCells(const CutMesh& cutMesh, const Measures& measures, std::vector<DoubleDouble>& sums) {
  operators::requireMadeFrom(measures.madeFrom, cutMesh.fingerprint, "The measures are those of another cut-mesh.");
  if (measures.cellVolume.size() != cutMesh.cellCount()) {
    operators::refuse("The measures are not of this cut-mesh: they have the volumes of " + std::to_string(measures.cellVolume.size()) +
                      " cut-cells, it has " + std::to_string(cutMesh.cellCount()) + ".");
  }
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) sums[cutMesh.cellRegion[c]] += measures.cellVolume[c];
}

void addUntouchedCells(const CutMesh& cutMesh, std::vector<DoubleDouble>& sums) {
  const auto extent = [&](size_t d, int32_t begin, int32_t end) {
    const std::vector<double>& planes = cutMesh.grid.planes[d];
    return twoSum(planes[size_t(end)], -planes[size_t(begin)]);
  };
  UntouchedCells(cutMesh).forEach([&](const UntouchedCells::Run& run) {
    sums[run.region] += extent(1, run.j, run.j + 1) * extent(2, run.k, run.k + 1) * extent(0, run.begin, run.end);
  });
}

}  // namespace detail

std::vector<double> regionVolumes(const CutMesh& cutMesh, const Measures& measures) {
  std::vector<detail::DoubleDouble> sums(cutMesh.regionCount);
  detail::addCutCells(cutMesh, measures, sums);
  detail::addUntouchedCells(cutMesh, sums);
  std::vector<double> volumes(sums.size());
  for (size_t r = 0; r < sums.size(); ++r) volumes[r] = double(sums[r]);
  return volumes;
}

}  // namespace mandoline
