#include "mandoline/locate.h"

#include <algorithm>

#include "base/sort.h"
#include "operators/locate/walls.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using operators::GridCell;

class Locator {
 public:
  Locator(const CutMesh& cutMesh, std::span<const double> points)
      : cutMesh_(cutMesh), points_(points), space_(cutMesh.grid), walls_(cutMesh, space_) {}

  Locations run() {
    const std::vector<uint32_t> inCut = findGridCells();
    for (size_t begin = 0, end; begin < inCut.size(); begin = end) {
      end = begin + 1;
      while (end < inCut.size() && gridCellOf(inCut[end]) == gridCellOf(inCut[begin])) ++end;
      findCells(std::span(inCut).subspan(begin, end - begin));
    }
    return std::move(result_);
  }

 private:
  GridCell gridCellOf(uint32_t i) const {
    const int32_t* g = &result_.gridCell[3 * size_t(i)];
    return {g[0], g[1], g[2]};
  }

  /// Fills in the grid cells, and the regions of untouched ones; returns the points in cut ones, by grid cells.
  std::vector<uint32_t> findGridCells() {
    const size_t count = points_.size() / 3;
    result_.cell.assign(count, -1);
    result_.gridCell.assign(3 * count, -1);
    result_.region.assign(count, -1);
    const UntouchedCells untouched(cutMesh_);
    std::vector<uint32_t> inCut;
    for (size_t i = 0; i < count; ++i) {
      GridCell at;
      if (!operators::findGridCell(cutMesh_.grid, &points_[3 * i], at)) continue;
      std::copy(at.begin(), at.end(), &result_.gridCell[3 * i]);
      result_.region[i] = int32_t(untouched.regionAt(at[0], at[1], at[2]));
      if (result_.region[i] < 0) inCut.push_back(uint32_t(i));
    }
    detail::sortItems(inCut, [&](uint32_t a, uint32_t b) { return gridCellOf(a) < gridCellOf(b); });
    return inCut;
  }

  /// Fills in the cut-cells of points of one grid cell.
  void findCells(std::span<const uint32_t> group) {
    const GridCell at = gridCellOf(group[0]);
    const IdRange cells = cutMesh_.cutCellsAt(at[0], at[1], at[2]);
    if (cells.size() == 0) return;  // the cut-mesh is not valid
    scaled_.clear();
    for (const uint32_t i : group) scaled_.push_back(space_.scaled(&points_[3 * size_t(i)]));
    walls_.load(cells, 1, scaled_);
    for (size_t n = 0; n < group.size(); ++n) {
      const uint32_t place = walls_.cellAt(scaled_[n]);
      if (place == operators::Walls::kNone) continue;
      result_.cell[group[n]] = int32_t(cells.begin + place);
      result_.region[group[n]] = int32_t(cutMesh_.cellRegion[cells.begin + place]);
    }
  }

  const CutMesh& cutMesh_;
  std::span<const double> points_;
  operators::ScaledSpace space_;
  operators::Walls walls_;
  std::vector<operators::ScaledPoint> scaled_;
  Locations result_;
};

}  // namespace

Locations cellsAt(const CutMesh& cutMesh, std::span<const double> points) {
  operators::requireCutMesh(cutMesh);
  if (points.size() % 3 != 0) operators::refuse("The points have " + std::to_string(points.size()) + " coordinates, no multiple of 3.");
  return Locator(cutMesh, points).run();
}

}  // namespace mandoline
