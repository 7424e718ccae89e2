#include "mesh/resolve/equal_points.h"

#include <algorithm>
#include <cmath>

#include "base/csr.h"
#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "mesh/resolve/exact_points.h"

namespace mandoline::detail {
namespace {

/// A point in one of the small boxes that its approximate coordinates reach.
struct Entry {
  std::array<int64_t, 3> box;
  uint32_t point;

  bool operator<(const Entry& other) const { return box != other.box ? box < other.box : point < other.point; }
};

void addEntries(const MeshPoints& points, uint32_t v, double size, std::vector<Entry>& entries) {
  std::array<int64_t, 3> low, high;
  for (size_t d = 0; d < 3; ++d) {
    const Bounded x = points.approximate(v, int(d));
    low[d] = int64_t(std::floor((x.value - 2 * x.error) / size));
    high[d] = int64_t(std::floor((x.value + 2 * x.error) / size));
  }
  for (int64_t i = low[0]; i <= high[0]; ++i) {
    for (int64_t j = low[1]; j <= high[1]; ++j) {
      for (int64_t k = low[2]; k <= high[2]; ++k) entries.push_back({{i, j, k}, v});
    }
  }
}

/// Calls f(u, v) for pairs of points at one place, among points near each other, so that the pairs connect all points there.
template <class F>
void forEqual(const MeshPoints& points, std::span<const uint32_t> group, Predicates& predicates, const F& f) {
  ExactPoints exact(points, group, predicates);
  const auto compare = [&](size_t i, size_t j) {
    int order = 0;
    for (int axis = 0; axis < 3 && order == 0; ++axis) order = exact.compare(i, j, axis);
    return order;
  };
  const std::vector<size_t> order = exact.sorted([&](size_t i, size_t j) { return compare(i, j) < 0; });
  for (size_t i = 1; i < order.size(); ++i) {
    if (compare(order[i - 1], order[i]) == 0) f(group[order[i - 1]], group[order[i]]);
  }
}

}  // namespace

std::vector<uint32_t> findEqualPoints(const MeshPoints& points, const std::vector<uint32_t>& triVertices, Predicates& predicates) {
  std::vector<uint32_t> candidates = triVertices;
  for (uint32_t v = points.firstMade(); v < points.size(); ++v) candidates.push_back(v);
  double largest = 0, error = 0;
  for (const uint32_t v : candidates) {
    for (int d = 0; d < 3; ++d) {
      largest = std::max(largest, std::fabs(points.approximate(v, d).value));
      error = std::max(error, points.approximate(v, d).error);
    }
  }
  const double size = std::max({8 * error, largest * 0x1p-58, 0x1p-1000});
  std::vector<Entry> entries;
  for (const uint32_t v : candidates) addEntries(points, v, size, entries);
  sortItems(entries);
  DisjointSets near(points.size());  // points that are connected by boxes which they share
  for (size_t i = 1; i < entries.size(); ++i) {
    if (entries[i - 1].box == entries[i].box) near.unite(entries[i - 1].point, entries[i].point);
  }
  const Csr<uint32_t> groups = groupBy<uint32_t>(
      points.size(), candidates.size(), [&](size_t i) { return near.find(candidates[i]); }, [&](size_t i) { return candidates[i]; });
  DisjointSets places(points.size());
  for (const auto group : groups.groups(0, groups.size())) {
    if (group.size() > 1) forEqual(points, group, predicates, [&](uint32_t u, uint32_t v) { places.unite(u, v); });
  }
  std::vector<uint32_t> placeOf(points.size());
  for (uint32_t v = 0; v < points.size(); ++v) placeOf[v] = places.find(v);
  return placeOf;
}

}  // namespace mandoline::detail
