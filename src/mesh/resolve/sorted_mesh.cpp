#include "mesh/resolve/sorted_mesh.h"

#include <algorithm>

#include "base/curve_order.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

std::vector<uint32_t> listKept(const std::vector<TriangleState>& states) {
  std::vector<uint32_t> list(states.size());
  size_t count = 0;
  for (uint32_t t = 0; t < states.size(); ++t) {
    list[count] = t;
    count += states[t] == TriangleState::kept;
  }
  list.resize(count);
  return list;
}

/// Marks the corners of triangles.
std::vector<uint8_t> cornersOf(const WeldedMesh& mesh, const std::vector<uint32_t>& some) {
  std::vector<uint8_t> isCorner(mesh.points.size(), 0);
  for (const uint32_t t : some) {
    for (const uint32_t v : mesh.triangles[t]) isCorner[v] = 1;
  }
  return isCorner;
}

uint32_t lowestOf(const std::array<uint32_t, 3>& corners) { return std::min(std::min(corners[0], corners[1]), corners[2]); }

}  // namespace

SortedMesh::SortedMesh(const WeldedMesh& mesh, const std::vector<TriangleState>& states) : SortedMesh(mesh, listKept(states)) {}

SortedMesh::SortedMesh(const WeldedMesh& mesh, const std::vector<uint32_t>& some) {
  const std::vector<uint8_t> isCorner = cornersOf(mesh, some);
  std::vector<uint32_t> corners;
  std::vector<Point> ofCorners;
  const bool isEach = std::find(isCorner.begin(), isCorner.end(), 0) == isCorner.end();  // else those that are, ascending
  for (uint32_t v = 0; v < isCorner.size() && !isEach; ++v) {
    if (!isCorner[v]) continue;
    corners.push_back(v);
    ofCorners.push_back(mesh.points[v]);
  }
  const std::span<const Point> unordered = isEach ? mesh.points : ofCorners;
  const auto idOf = [&](size_t i) { return isEach ? uint32_t(i) : corners[i]; };
  std::vector<uint32_t> places(mesh.points.size());
  points.reserve(unordered.size());
  for (const KeyedItem& corner : orderAlongCurve(unordered, idOf)) {
    places[idOf(corner.item)] = uint32_t(points.size());
    points.push_back(unordered[corner.item]);
  }
  const auto placesOf = [&](size_t t) {
    const auto& v = mesh.triangles[t];
    return std::array{places[v[0]], places[v[1]], places[v[2]]};
  };
  std::vector<uint32_t> at(points.size() + 1, 0);  // where the next triangle with this lowest corner goes
  for (const uint32_t t : some) ++at[lowestOf(placesOf(t)) + 1];
  for (size_t v = 0; v < points.size(); ++v) at[v + 1] += at[v];
  triangles.resize(some.size());
  ids.resize(some.size());
  for (const uint32_t t : some) {
    const auto v = placesOf(t);
    const uint32_t place = at[lowestOf(v)]++;
    triangles[place] = v;
    ids[place] = t;
  }
  dropDuplicates(at);
}

/// Triangles with the same lowest corner are beside each other, ascending by id, up to where `ends` says: of those with the same corners
/// the first is kept.
void SortedMesh::dropDuplicates(const std::vector<uint32_t>& ends) {
  struct Others {
    uint64_t corners;  ///< but the lowest: the highest, then the third one
    uint32_t place;
  };
  std::vector<Others> group;
  std::vector<uint8_t> isDuplicate;  // empty if there is none
  for (uint32_t lowest = 0, first = 0; lowest < points.size(); first = ends[lowest++]) {
    uint64_t sums = 0;  // of corners, mixed to one of 64 bits: triangles with different ones differ
    bool mayBeSame = false;
    for (uint32_t place = first; place < ends[lowest]; ++place) {
      const auto& [a, b, c] = triangles[place];
      const uint64_t bit = uint64_t(1) << ((a + b + c) * 0x9e3779b1u >> 26);
      mayBeSame |= (sums & bit) != 0;
      sums |= bit;
    }
    if (!mayBeSame) continue;
    group.clear();
    for (uint32_t place = first; place < ends[lowest]; ++place) {
      const auto& [a, b, c] = triangles[place];
      const uint32_t highest = std::max(std::max(a, b), c), third = a + b + c - highest - lowest;
      group.push_back({uint64_t(highest) << 32 | third, place});
    }
    sortItems(group, [](const Others& a, const Others& b) { return a.corners < b.corners; });
    for (size_t i = 1; i < group.size(); ++i) {
      if (group[i].corners != group[i - 1].corners) continue;
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
