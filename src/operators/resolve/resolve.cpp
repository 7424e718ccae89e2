#include "mandoline/resolve.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "mandoline/triangulate.h"
#include "mesh/run_call.h"
#include "operators/measure/owners.h"
#include "operators/mesh_writer.h"

namespace mandoline {
namespace {

/// One cell around the mesh, so large that no triangle reaches its sides.
Grid cellAround(const MeshView& mesh) {
  double low[3], high[3], size = 0;
  for (size_t d = 0; d < 3; ++d) {
    low[d] = INFINITY;
    high[d] = -INFINITY;
    for (const uint32_t v : mesh.triangles) {
      const double x = 3 * size_t(v) + d < mesh.positions.size() ? mesh.positions[3 * size_t(v) + d] : NAN;
      if (!std::isfinite(x)) continue;
      low[d] = std::min(low[d], x);
      high[d] = std::max(high[d], x);
    }
    size = std::max({size, high[d] / 2 - low[d] / 2, std::fabs(low[d]) * 0x1p-20, std::fabs(high[d]) * 0x1p-20});
  }
  if (!(size > 0) || !std::isfinite(size)) size = 1;
  Grid grid;
  for (size_t d = 0; d < 3; ++d) {
    if (!(low[d] <= high[d])) low[d] = high[d] = 0;
    grid.planes[d] = {std::max(low[d] - size, -1.7e308), std::min(high[d] + size, 1.7e308)};
  }
  return grid;
}

ResolvedMesh resolvedOf(const CutMesh& cutMesh) {
  ResolvedMesh result;
  const FaceTriangles faces = triangulateFaces(cutMesh);
  operators::MeshWriter writer(cutMesh.positions, result.mesh);
  result.parentOffsets.push_back(0);
  result.hasWinding = cutMesh.hasWinding;
  const std::vector<int32_t> owners = operators::ownersOf(cutMesh);
  const auto addAt = [&](size_t halfFace, const auto& ofRegions, auto& out) {  // 0 beyond the grid
    using Number = typename std::remove_reference_t<decltype(out)>::value_type;
    if (ofRegions.empty()) return;
    out.push_back(owners[halfFace] < 0 ? Number(0) : ofRegions[cutMesh.cellRegion[size_t(owners[halfFace])]]);
  };
  for (size_t f = 0; f < cutMesh.faceCount(); ++f) {
    if (cutMesh.faceTriangle[f] < 0) continue;
    for (uint32_t t = faces.faceTriangleOffsets[f]; t < faces.faceTriangleOffsets[f + 1]; ++t) {
      writer.add(&faces.triangles[3 * size_t(t)], false);
      for (uint32_t p = cutMesh.faceParentOffsets[f]; p < cutMesh.faceParentOffsets[f + 1]; ++p) {
        result.parents.push_back(cutMesh.faceParents[p]);
        result.parentSigns.push_back(cutMesh.faceParentSigns[p]);
      }
      result.parentOffsets.push_back(uint32_t(result.parents.size()));
      addAt(2 * f, cutMesh.regionWinding, result.backWinding);
      addAt(2 * f + 1, cutMesh.regionWinding, result.frontWinding);
      addAt(2 * f, cutMesh.regionPartWinding, result.backPartWinding);
      addAt(2 * f + 1, cutMesh.regionPartWinding, result.frontPartWinding);
      addAt(2 * f, cutMesh.regionParity, result.backParity);
      addAt(2 * f + 1, cutMesh.regionParity, result.frontParity);
    }
  }
  for (const uint32_t v : writer.used()) result.vertexTriVertex.push_back(cutMesh.vertexTriVertex[v]);
  return result;
}

constexpr int kCountingStages = 2;  // of findIntersections()

/// Cuts, and counts the pairs that rounding brings back.
void run(const MeshView& mesh, const RunOptions& options, ResolveResult& result) {
  detail::Monitor monitor(options, kCountingStages);
  CutResult cutResult = cut(mesh, cellAround(mesh), monitor.part<CutOptions>(0, kCountingStages));
  result.error = std::move(cutResult.error);
  result.stats = std::move(cutResult.stats);
  if (!result) return;
  result.mesh = resolvedOf(cutResult.mesh);
  if (result.stats.intersections.total() == 0) return;
  auto counting = monitor.part<IntersectionOptions>(int(result.stats.stages.size()), 0);
  counting.maxPairs = 0;
  result.remaining = findIntersections(result.mesh.mesh, counting).counts;
}

}  // namespace

ResolveResult resolve(const MeshView& mesh, const RunOptions& options) {
  ResolveResult result;
  detail::catchErrors(result.error, "resolution", [&] { run(mesh, options, result); });
  if (!result) result.mesh = {};
  return result;
}

}  // namespace mandoline
