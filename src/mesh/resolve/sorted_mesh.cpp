#include "mesh/resolve/sorted_mesh.h"

#include <algorithm>

#include "base/curve_order.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// The corners of kept triangles, ascending.
std::vector<uint32_t> cornersOfKept(const WeldedMesh& mesh, const std::vector<TriangleState>& states) {
  std::vector<uint8_t> isCorner(mesh.points.size(), 0);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (states[t] != TriangleState::kept) continue;
    for (const uint32_t v : mesh.triangles[t]) isCorner[v] = 1;
  }
  std::vector<uint32_t> corners;
  for (uint32_t v = 0; v < isCorner.size(); ++v) {
    if (isCorner[v]) corners.push_back(v);
  }
  return corners;
}

uint32_t lowestOf(const std::array<uint32_t, 3>& corners) { return std::min({corners[0], corners[1], corners[2]}); }

}  // namespace

SortedMesh::SortedMesh(const WeldedMesh& mesh, const std::vector<TriangleState>& states) {
  const std::vector<uint32_t> corners = cornersOfKept(mesh, states);
  std::vector<Point> unordered;
  unordered.reserve(corners.size());
  for (const uint32_t v : corners) unordered.push_back(mesh.points[v]);
  std::vector<uint32_t> places(mesh.points.size());
  points.reserve(corners.size());
  for (const KeyedItem& corner : orderAlongCurve(unordered, [&](size_t i) { return corners[i]; })) {
    places[corners[corner.item]] = uint32_t(points.size());
    points.push_back(unordered[corner.item]);
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
