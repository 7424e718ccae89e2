#include "operators/slice/plane_stack.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "base/sort.h"
#include "operators/require_cut_mesh.h"

namespace mandoline::operators {

ScaledGrid::ScaledGrid(const Grid& grid, const ScaledSpace& space) {
  for (int d = 0; d < 3; ++d) {
    planes[d].reserve(grid.planes[d].size());
    for (const double x : grid.planes[d]) planes[d].push_back(space.scaled(x));
  }
}

void requireNormal(const std::array<double, 3>& normal) {
  for (int d = 0; d < 3; ++d) {
    if (!std::isfinite(normal[size_t(d)])) refuse("The plane's normal has a component that is not finite.", d);
  }
  if (normal == std::array<double, 3>{}) refuse("The plane's normal is zero.");
}

PlaneStack::PlaneStack(const std::array<double, 3>& normal, std::span<const double> offsets, const Grid& grid, const ScaledSpace& space) {
  requireNormal(normal);
  for (size_t i = 0; i < offsets.size(); ++i) {
    if (!std::isfinite(offsets[i])) refuse("Offset " + std::to_string(i) + " of the plane is not finite.", int64_t(i));
  }
  std::vector<size_t> order(offsets.size());
  std::iota(order.begin(), order.end(), size_t(0));
  detail::sortItems(order, [&](size_t a, size_t b) { return offsets[a] < offsets[b]; });
  for (const size_t i : order) {
    const std::optional<CuttingPlane> plane = CuttingPlane::make({normal, offsets[i]}, grid, space);
    if (!plane) continue;
    planes_.push_back(*plane);
    offsets_.push_back(plane->offset());
    given_.push_back(i);
  }
}

uint32_t PlaneStack::countBelow(const ScaledPoint& p) const {
  if (planes_.empty()) return 0;
  // The rounded height is off by some planes at most, if any.
  const ScaledPoint& normal = planes_[0].normal();
  const double height = normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2];
  size_t below = size_t(std::upper_bound(offsets_.begin(), offsets_.end(), height) - offsets_.begin());
  while (below < planes_.size() && planes_[below].isAbove(p)) ++below;
  while (below > 0 && !planes_[below - 1].isAbove(p)) --below;
  return uint32_t(below);
}

std::pair<uint32_t, uint32_t> PlaneStack::planesThrough(const Box& box) const {
  if (planes_.empty()) return {0, 0};
  ScaledPoint bottom, top;
  for (size_t d = 0; d < 3; ++d) {
    const bool up = planes_[0].normal()[d] > 0;
    bottom[d] = box[up ? 0 : 1][d];
    top[d] = box[up ? 1 : 0][d];
  }
  return {countBelow(bottom), countBelow(top)};
}

detail::Csr<uint32_t> PlaneStack::boxesOf(const std::vector<std::pair<uint32_t, uint32_t>>& planesOf) const {
  detail::Csr<uint32_t> boxes;
  boxes.offsets.assign(planes_.size() + 1, 0);
  for (const auto& [first, end] : planesOf) {
    for (uint32_t p = first; p < end; ++p) ++boxes.offsets[p + 1];
  }
  std::partial_sum(boxes.offsets.begin(), boxes.offsets.end(), boxes.offsets.begin());
  boxes.items.resize(boxes.offsets.back());
  std::vector<uint32_t> at(boxes.offsets.begin(), boxes.offsets.end() - 1);
  for (uint32_t b = 0; b < planesOf.size(); ++b) {
    for (uint32_t p = planesOf[b].first; p < planesOf[b].second; ++p) boxes.items[at[p]++] = b;
  }
  return boxes;
}

namespace {

const CutMesh& required(const CutMesh& cutMesh) {
  requireCutMesh(cutMesh);
  return cutMesh;
}

detail::Csr<uint32_t> cellsCut(const PlaneStack& planes, const ScaledGrid& grid, const CutMesh& cutMesh) {
  return planes.boxesCut(cutMesh.cellCount(), [&](size_t c) {
    const int32_t* at = &cutMesh.cellGridCell[3 * c];
    const size_t i = size_t(at[0]), j = size_t(at[1]), k = size_t(at[2]);
    return PlaneStack::Box{grid.corner(i, j, k), grid.corner(i + 1, j + 1, k + 1)};
  });
}

}  // namespace

PlanarCuts::PlanarCuts(const CutMesh& cutMesh, const std::array<double, 3>& normal, std::span<const double> offsets)
    : space(required(cutMesh).grid),
      grid(cutMesh.grid, space),
      planes(normal, offsets, cutMesh.grid, space),
      cells(cellsCut(planes, grid, cutMesh)) {}

}  // namespace mandoline::operators
