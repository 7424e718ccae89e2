// Checks of a cut-mesh (paper, 5.6). The total volume needs no check of its own: the stencil makes each grid cell either cut or untouched,
// and the cut-cells of a grid cell fill it.
#include "operators/validate/bins.h"

namespace mandoline {

Validation validate(const MeshView& mesh, const CutMesh& cutMesh, double snapTolerance) {
  using namespace validation;
  Validation result;
  result.checks.push_back(checkArrays(cutMesh, &mesh));
  if (result.checks[0].pass) {
    const Context context(mesh, cutMesh, snapTolerance);
    const TriangleBins bins(context);
    std::vector<double> cellVolumes;
    std::vector<Sample> samples;
    std::vector<uint8_t> overlapping;
    checkVertices(context, result.checks);
    checkFaces(context, result.checks);
    checkGridCells(context, result.checks, cellVolumes, samples);
    checkSurface(context, bins, result.checks, overlapping);
    checkRegions(context, bins, result.checks);
    checkWinding(context, bins, cellVolumes, overlapping, std::move(samples), result.checks);
  } else {
    result.checks[0].message += "; all other checks are left out";
  }
  for (const Check& check : result.checks) result.pass &= check.pass;
  return result;
}

}  // namespace mandoline
