// Checks of a cut-mesh (paper, 5.6): the passes in their order. The total volume needs no check of its own: the stencil makes each grid
// cell either cut or untouched, and the cut-cells of a grid cell fill it.
#include "mandoline/validate.h"

#include "mesh/run_call.h"
#include "operators/validate/passes.h"

namespace mandoline {
namespace {

constexpr int kStages = 6;

std::vector<Check> checkAll(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options, Check arrays) {
  using namespace validation;
  detail::Monitor monitor(options, kStages);
  monitor.beginStage("input", 0);
  const Context context(mesh, cutMesh);
  const InputTopology topology = findTopology(context);
  const TriangleBins bins(context);
  monitor.beginStage("vertices", 1);
  const VertexChecks vertices = checkVertices(context, monitor);
  monitor.beginStage("faces", 2);
  const FaceChecks faces = checkFaces(context, monitor);
  monitor.beginStage("gridCells", 3);
  const GridCellChecks gridCells = checkGridCells(context, monitor);
  monitor.beginStage("surface", 4);
  const SurfaceChecks surface = checkSurface(context, monitor);
  monitor.beginStage("regions", 5);
  const RegionChecks regions = checkRegions(context, bins);
  const WindingChecks winding = checkWinding(context, topology, bins, gridCells);
  return {arrays,
          vertices.vertices,
          vertices.positions,
          faces.faces,
          faces.planarity,
          faces.orientation,
          faces.halfFaces,
          faces.isolation,
          gridCells.closedCells,
          gridCells.facingFaces,
          gridCells.conforming,
          gridCells.crossings,
          gridCells.gridFaces,
          gridCells.connected,
          gridCells.distinctCells,
          gridCells.cellVolume,
          gridCells.gridCellVolume,
          gridCells.gridFaceArea,
          gridCells.partition,
          surface.area,
          surface.droppedTriangles,
          regions.stencil,
          regions.regions,
          winding.windingNumber,
          winding.inputVolume};
}

}  // namespace

Validation validate(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options) {
  Validation result;
  Check arrays = checkArrays(cutMesh, &mesh);
  if (arrays.pass) {
    result.checks = detail::runCall("validation", [&] { return checkAll(mesh, cutMesh, options, std::move(arrays)); });
  } else {
    arrays.message += " All other checks are left out.";
    result.checks.push_back(std::move(arrays));
  }
  for (const Check& check : result.checks) result.pass &= check.pass;
  return result;
}

}  // namespace mandoline
