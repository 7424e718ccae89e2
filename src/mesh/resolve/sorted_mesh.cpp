#include "mesh/resolve/sorted_mesh.h"

#include "base/curve_order.h"

namespace mandoline::detail {

SortedMesh::SortedMesh(const WeldedMesh& mesh) {
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
  const auto lowest = [](const std::array<uint32_t, 3>& v) { return std::min({v[0], v[1], v[2]}); };
  size_t count = 0;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.kept(t)) continue;
    ++at[lowest(cornersOf(t)) + 1];
    ++count;
  }
  for (size_t v = 0; v < points.size(); ++v) at[v + 1] += at[v];
  triangles.resize(count);
  ids.resize(count);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.kept(t)) continue;
    const auto v = cornersOf(t);
    const uint32_t place = at[lowest(v)]++;
    triangles[place] = v;
    ids[place] = uint32_t(t);
  }
}

}  // namespace mandoline::detail
