#include "mandoline/refine.h"

#include <algorithm>
#include <cmath>

#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "operators/refine/finish.h"
#include "operators/refine/leaves.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using namespace refining;

constexpr int kMostLevels = 24;
constexpr int64_t kMostCells = int64_t(1) << 24;

[[noreturn]] void refuseOption(const std::string& message) { throw CallError({Status::badOption, -1, -1, message}); }

void requireOptions(const RefineOptions& options) {
  const auto isLevel = [](int levels) { return levels >= 0 && levels <= kMostLevels; };
  if (!isLevel(options.levels)) refuseOption("levels has to be from 0 to 24.");
  if (!(options.angle >= 0 && options.angle <= 180)) refuseOption("The angle has to be from 0 to 180 degrees.");
  if (options.layers < 1) refuseOption("There has to be at least one layer of cells of each size.");
  if (!isLevel(options.rule.levels) || (options.rule.levels > 0) != bool(options.rule.divides))
    refuseOption("A rule has to have a function and from 1 to 24 levels.");
  for (const RefinementBox& box : options.boxes) {
    bool isBox = isLevel(box.levels);
    for (size_t d = 0; d < 3; ++d) isBox &= std::isfinite(box.min[d]) && std::isfinite(box.max[d]) && box.min[d] < box.max[d];
    if (!isBox) refuseOption("A box has to have finite corners, min below max, and from 0 to 24 levels.");
  }
}

void requireCut(const PreparedMesh& mesh, const CutMesh& cutMesh) {
  operators::requireCutMesh(cutMesh);
  if (cutMesh.snapTolerance != 0) operators::refuse("The cut-mesh was made with snapping, which smaller cells can't have.");
  if (!cutMesh.regionInsideness.empty())
    operators::refuse("Cells can't be refined where regions are divided by an estimate of what is inside.");
  constexpr const char* kOther = "The cut-mesh was not made from this mesh.";
  const MeshView view = mesh.mesh();
  if (!mesh.data() || view.triangles.size() != 3 * size_t(cutMesh.triangleCount)) operators::refuse(kOther);
  operators::requireMadeFrom(cutMesh.madeFrom, detail::fingerprintOf(view), kOther);
  double size = 0;
  for (const auto& planes : cutMesh.grid.planes) size = std::max(size, planes.back() - planes.front());
  operators::requireLength(size);
}

void requireFewCells(const Grid& grid, int levels) {
  double all = 1;
  for (int d = 0; d < 3; ++d) {
    all *= double(grid.cells(d) << levels) + 1;
    if (grid.cells(d) << levels > kMostCells)
      throw CallError({Status::gridTooLarge, d, -1, "There would be more than 2^24 of the smallest cells along an axis."});
  }
  if (all >= 9e18) throw CallError({Status::gridTooLarge, 0, -1, "There would be more than 2^63 of the smallest cells in the grid."});
}

/// A function tells nothing of what it will say: the cells do.
Fingerprint fingerprintOf(const CutMesh& cutMesh, const RefineOptions& options, const CellComplex& cells, std::string_view kind) {
  detail::Fingerprinter fingerprinter(kind, cutMesh.fingerprint);
  const CoarsenOptions coarsening = operators::meantFor(cutMesh.grid, options.coarsening);
  for (const int option : {options.levels, options.layers, coarsening.maxLevel, coarsening.fineLayers, coarsening.layersPerLevel,
                           int(coarsening.balanceEdges)})
    fingerprinter.add(uint64_t(option));
  fingerprinter.add(options.angle);
  for (const RefinementBox& box : options.boxes) {
    fingerprinter.add(std::span<const double>(box.min));
    fingerprinter.add(std::span<const double>(box.max));
    fingerprinter.add(uint64_t(box.levels));
  }
  if (options.rule.divides) {
    for (const int32_t x : cells.cellCorner) fingerprinter.add(uint64_t(x));
    for (const uint8_t level : cells.cellLevel) fingerprinter.add(uint64_t(level));
  }
  return fingerprinter.get();
}

RefinedCells refine(const PreparedMesh& mesh, const CutMesh& cutMesh, const RefineOptions& options) {
  detail::Monitor monitor(options, 4);
  const int levels = mostLevels(options);
  monitor.beginStage("levels", 0);
  std::vector<Grid> grids;
  for (int level = 0; level <= levels; ++level) grids.push_back(dividedGrid(cutMesh.grid, levels - level));
  const OctreeCells leaves = findLeaves(mesh.mesh(), cutMesh, grids[0].planes, options, monitor);
  monitor.beginStage("cut", 1);
  Parts parts(mesh, cutMesh, grids, leaves);
  parts.cut(monitor);
  monitor.beginStage("vertices", 2);
  const SharedIds ids(mesh.mesh(), parts, leaves, monitor);
  monitor.beginStage("faces", 3);
  const Sources sources{leaves, parts, ids, cutMesh};
  RefinedCells result = finish(Assembly(sources, monitor).run(), sources, grids[0], monitor);
  result.levels = levels;
  return result;
}

}  // namespace

Grid dividedGrid(const Grid& grid, int levels) {
  if (levels < 0 || levels > kMostLevels) refuseOption("levels has to be from 0 to 24.");
  requireFewCells(grid, levels);
  std::array<double, 3> min, max, spacing;
  std::array<int64_t, 3> cells;
  for (size_t d = 0; d < 3; ++d) {
    cells[d] = grid.cells(int(d)) << levels;
    if (grid.cells(int(d)) == 0) return grid;
    min[d] = grid.planes[d].front();
    max[d] = grid.planes[d].back();
    spacing[d] = std::ldexp(grid.spacing[d], -levels);
  }
  const auto hasPlanes = [&](const Grid& divided) {
    for (size_t d = 0; d < 3; ++d) {
      for (size_t c = 0; c < grid.planes[d].size(); ++c) {
        if (divided.planes[d].size() <= c << levels || divided.planes[d][c << levels] != grid.planes[d][c]) return false;
      }
    }
    return true;
  };
  if (grid.uniform) {  // as it was made itself
    for (const Grid& divided : {Grid::box(min, max, cells), Grid::regular(grid.origin, spacing, cells)}) {
      if (hasPlanes(divided)) return divided;
    }
  }
  std::array<std::vector<double>, 3> planes = grid.planes;
  for (int level = 0; level < levels; ++level) {
    for (std::vector<double>& axis : planes) {
      std::vector<double> halved;
      for (size_t c = 0; c + 1 < axis.size(); ++c) halved.insert(halved.end(), {axis[c], axis[c] / 2 + axis[c + 1] / 2});
      halved.push_back(axis.back());
      axis = std::move(halved);
    }
  }
  return Grid::rectilinear(std::move(planes));
}

RefinedCells refineCells(const PreparedMesh& mesh, const CutMesh& cutMesh, const RefineOptions& options) {
  requireOptions(options);
  requireCut(mesh, cutMesh);
  requireFewCells(cutMesh.grid, mostLevels(options));
  return detail::runCall("refinement", [&] {
    RefinedCells result = refine(mesh, cutMesh, options);
    result.cutMesh.fingerprint = result.cells.madeFrom = fingerprintOf(cutMesh, options, result.cells, "refined cut");
    result.cells.fingerprint = fingerprintOf(cutMesh, options, result.cells, "refined cells");
    return result;
  });
}

}  // namespace mandoline
