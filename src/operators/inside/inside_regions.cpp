#include "operators/inside/inside_rule.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {

InsideRegions insideRegions(const CutMesh& cutMesh, const InsideOptions& options) {
  operators::requireNotEmpty(cutMesh);
  operators::requireThreshold(options.threshold);
  InsideRegions result;
  if (cutMesh.hasWinding) {
    for (const int32_t winding : cutMesh.regionWinding) result.isInside.push_back(operators::isInside(winding, options.rule));
    return result;
  }
  const bool hasEstimates = !cutMesh.regionInsideness.empty(), hasParity = !cutMesh.regionParity.empty();
  if (!hasEstimates && !hasParity) {
    operators::refuse(
        "No part of the mesh is closed, so that nothing is inside for certain. estimateInside() gives a cut-mesh with an estimate; or "
        "close "
        "the mesh: inspect() tells its open edges.");
  }
  result.isComplete = hasEstimates || cutMesh.openTriangles.empty();
  if (!cutMesh.parityTriangles.empty()) result.by = InsideBy::parity;
  if (hasEstimates) result.by = InsideBy::estimate;
  for (uint32_t r = 0; r < cutMesh.regionCount; ++r) {
    const int32_t part = cutMesh.regionPartWinding.empty() ? 0 : cutMesh.regionPartWinding[r];
    const int32_t winding = hasEstimates ? operators::roundedWinding(cutMesh.regionInsideness[r], options.threshold) : part;
    const bool isOddByParity = hasParity && (cutMesh.regionParity[r] != 0) != (part % 2 != 0);
    result.isInside.push_back(operators::isInside(winding, isOddByParity != (winding % 2 != 0), options.rule));
  }
  return result;
}

}  // namespace mandoline
