#include "mesh/resolve/sorted_mesh.h"

#include <algorithm>

#include "base/curve_order.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

uint32_t lowestOf(const std::array<uint32_t, 3>& corners) { return std::min({corners[0], corners[1], corners[2]}); }

}  // namespace

SortedMesh::SortedMesh(const WeldedMesh& mesh, const std::vector<TriangleState>& states) {
  const auto order = orderAlongCurve(mesh.points, [](size_t v) { return uint32_t(v); });
  std::vector<uint32_t> places(order.size());
  points.reserve(order.size());
  for (const KeyedItem& vertex : order) {
    places[vertex.item] = uint32_t(points.size());
    points.push_back(mesh.points[vertex.item]);
  }
  const auto cornersOf = [&](size_t t) {
    const auto& v = mesh.triangles[t];
    return std::array{places[v[0]], places[v[1]], places[v[2]]};
  };
  std::vector<uint32_t> at(points.size() + 1, 0);  // where the next triangle with this lowest corner goes
  size_t count = 0;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (states[t] != TriangleState::kept) continue;
    ++at[lowestOf(cornersOf(t)) + 1];
    ++count;
  }
  for (size_t v = 0; v < points.size(); ++v) at[v + 1] += at[v];
  triangles.resize(count);
  ids.resize(count);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (states[t] != TriangleState::kept) continue;
    const auto v = cornersOf(t);
    const uint32_t place = at[lowestOf(v)]++;
    triangles[place] = v;
    ids[place] = uint32_t(t);
  }
  dropDuplicates();
}

/// Triangles with the same lowest corner are beside each other, ascending by id: of those with the same corners the first is kept.
void SortedMesh::dropDuplicates() {
  struct Corners {
    std::array<uint32_t, 3> sorted;
    size_t place;
  };
  std::vector<Corners> group;
  std::vector<uint8_t> isDuplicate;  // empty if there is none
  for (size_t begin = 0; begin < triangles.size(); begin += group.size()) {
    group.clear();
    do {
      const size_t place = begin + group.size();
      group.push_back({triangles[place], place});
      sortItems(group.back().sorted);
    } while (begin + group.size() < triangles.size() && lowestOf(triangles[begin + group.size()]) == group[0].sorted[0]);
    if (group.size() == 1) continue;
    sortItems(group, [](const Corners& a, const Corners& b) { return a.sorted < b.sorted; });
    for (size_t i = 1; i < group.size(); ++i) {
      if (group[i].sorted != group[i - 1].sorted) continue;
      isDuplicate.resize(triangles.size(), 0);
      isDuplicate[group[i].place] = 1;
    }
  }
  if (isDuplicate.empty()) return;
  size_t kept = 0;
  for (size_t place = 0; place < triangles.size(); ++place) {
    if (isDuplicate[place]) continue;
    triangles[kept] = triangles[place];
    ids[kept++] = ids[place];
  }
  triangles.resize(kept);
  ids.resize(kept);
}

}  // namespace mandoline::detail
