#include "mandoline/grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/exact.h"

namespace mandoline {
namespace {

using detail::Expansion;

constexpr int64_t kMostCells = int64_t(1) << 24;

// Planes are rounded once, from exact sums: then a symmetric box has symmetric planes, and symmetric or flat parts of a mesh lie on
// them or clear of them rather than off by one rounding. Sizes near the limits of doubles are rounded as they come.
bool safeToMultiply(double x) { return x == 0 || (std::fabs(x) < 0x1p900 && std::fabs(x) > 0x1p-900); }

/// Cell counts that make no sense leave the axis without planes or with too many, which cut() reports.
template <class PlaneAt>
std::vector<double> makePlanes(int64_t cells, const PlaneAt& planeAt) {
  std::vector<double> planes;
  if (cells < 1) return planes;
  planes.resize(size_t(std::min(cells, kMostCells + 1)) + 1);
  if (cells > kMostCells) return planes;
  for (int64_t c = 0; c <= cells; ++c) planes[size_t(c)] = planeAt(c);
  return planes;
}

}  // namespace

Grid Grid::box(const std::array<double, 3>& min, const std::array<double, 3>& max, const std::array<int64_t, 3>& cells) {
  Grid grid;
  grid.uniform = true;
  grid.origin = min;
  for (int d = 0; d < 3; ++d) {
    const double n = double(cells[d]);
    grid.spacing[d] = (max[d] - min[d]) / n;
    grid.planes[d] = makePlanes(cells[d], [&](int64_t c) {
      if (c == 0 || c == cells[d]) return c == 0 ? min[d] : max[d];
      if (!safeToMultiply(min[d]) || !safeToMultiply(max[d])) return min[d] + (max[d] - min[d]) * (double(c) / n);
      return Expansion::quotient(Expansion(min[d]) * Expansion(n - double(c)) + Expansion(max[d]) * Expansion(double(c)), Expansion(n));
    });
  }
  return grid;
}

Grid Grid::regular(const std::array<double, 3>& origin, const std::array<double, 3>& spacing, const std::array<int64_t, 3>& cells) {
  Grid grid;
  grid.uniform = true;
  grid.origin = origin;
  grid.spacing = spacing;
  for (int d = 0; d < 3; ++d) grid.planes[d] = makePlanes(cells[d], [&](int64_t c) { return origin[d] + spacing[d] * double(c); });
  return grid;
}

Grid Grid::rectilinear(std::array<std::vector<double>, 3> planes) {
  Grid grid;
  grid.planes = std::move(planes);
  for (int d = 0; d < 3; ++d) grid.origin[d] = grid.planes[d].empty() ? 0 : grid.planes[d][0];
  return grid;
}

Grid Grid::around(const MeshView& mesh, int64_t n, double margin) {
  constexpr double kLargestMargin = 1e6;
  if (!(margin >= 0 && margin <= kLargestMargin)) n = 0;
  std::array<double, 3> low, high;
  low.fill(INFINITY);
  high.fill(-INFINITY);
  for (const uint32_t v : mesh.triangles) {
    for (int d = 0; d < 3 && v < mesh.vertexCount(); ++d) {
      const double x = mesh.positions[3 * size_t(v) + d];
      if (!std::isfinite(x)) continue;
      low[d] = std::min(low[d], x);
      high[d] = std::max(high[d], x);
    }
  }
  double longest = 0;
  for (int d = 0; d < 3; ++d) longest = std::max(longest, high[d] - low[d]);
  if (!(longest > 0)) longest = 1;  // a point, or nothing
  Grid grid;
  grid.uniform = true;
  const double spacing = (1 + 2 * margin) * longest / double(n);
  for (int d = 0; d < 3; ++d) {
    if (!(low[d] <= high[d])) low[d] = high[d] = 0;
    const double span = high[d] - low[d] + 2 * (margin * longest), middle = 0.5 * low[d] + 0.5 * high[d];
    // Rounding must not turn a side of just n cells into n + 1.
    const double count = std::ceil(span / spacing * (1 - 1e-12));
    const int64_t cells = n < 1 || !(count < double(n)) ? n : int64_t(std::max(count, 1.0));
    grid.planes[d] = makePlanes(cells, [&](int64_t c) {
      const double halves = double(2 * c - cells);
      if (!safeToMultiply(spacing)) return middle + 0.5 * spacing * halves;
      return (Expansion(middle) + Expansion(0.5 * spacing) * Expansion(halves)).estimate();
    });
    grid.spacing[d] = spacing;
    if (!grid.planes[d].empty()) grid.origin[d] = grid.planes[d][0];
  }
  return grid;
}

}  // namespace mandoline
