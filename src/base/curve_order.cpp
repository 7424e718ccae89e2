#include "base/curve_order.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace mandoline::detail {

namespace {

/// The points with 0 for what is not finite; `replaced` holds them if there is such.
std::span<const Point> finite(std::span<const Point> points, std::vector<Point>& replaced) {
  double zero = 0;
  for (const Point& p : points) zero += p[0] * 0 + p[1] * 0 + p[2] * 0;
  if (zero == 0) return points;
  replaced.assign(points.begin(), points.end());
  for (Point& p : replaced) {
    for (double& x : p) x = std::isfinite(x) ? x : 0;
  }
  return replaced;
}

}  // namespace

std::vector<KeyedItem> orderAlongCurve(std::span<const Point> points, FunctionRef<uint32_t(size_t)> idOf) {
  constexpr int kBits = 21, kFewDiffer = 30;  // of an axis; the last bits, in which alone few differ
  std::vector<Point> replaced;
  points = finite(points, replaced);
  Point low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY}, scale{};
  for (const Point& p : points) {
    for (size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  }
  for (size_t d = 0; d < 3; ++d) {
    scale[d] = high[d] > low[d] ? 1 / (high[d] / 2 - low[d] / 2) : 0;
    if (!std::isfinite(scale[d])) scale[d] = 0;
  }
  const auto spread = [](uint64_t x) {  // two zeros behind each bit
    x = (x | x << 32) & 0x001f00000000ffff;
    x = (x | x << 16) & 0x001f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
  };
  std::vector<KeyedItem> order;
  order.reserve(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    uint64_t key = 0;
    for (size_t d = 0; d < 3; ++d) {
      const double part = std::min((p[d] / 2 - low[d] / 2) * scale[d], 1.0);  // from 0 on
      key |= spread(uint32_t(part * double((1 << kBits) - 1))) << d;
    }
    order.push_back({key, uint32_t(i)});
  }
  sortByKey(order, uint64_t(1) << (3 * kBits - 1), kFewDiffer);
  for (size_t i = 0, end; i < order.size(); i = end) {
    for (end = i + 1; end < order.size() && order[end].key >> kFewDiffer == order[i].key >> kFewDiffer;) ++end;
    if (end - i > 1) {
      sortItems(std::span<KeyedItem>(order.data() + i, end - i),
                [&](const KeyedItem& a, const KeyedItem& b) { return a.key != b.key ? a.key < b.key : idOf(a.item) < idOf(b.item); });
    }
  }
  return order;
}

}  // namespace mandoline::detail
