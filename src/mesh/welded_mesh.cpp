#include "mesh/welded_mesh.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/position_table.h"

namespace mandoline::detail {
namespace {

bool hasArea(Predicates& predicates, const Point& a, const Point& b, const Point& c) {
  for (int d = 0; d < 3; ++d) {
    const int p = (d + 1) % 3, q = (d + 2) % 3;
    if (predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]}) != 0) return true;
  }
  return false;
}

}  // namespace

std::vector<uint32_t> weld(const std::vector<uint8_t>& referenced, const std::vector<Point>& points) {
  PositionTable table(points.size(), [&](uint32_t v) { return points[v].data(); });
  std::vector<uint32_t> lowest(points.size());
  for (uint32_t v = 0; v < points.size(); ++v) {
    lowest[v] = v;
    if (!referenced[v]) continue;
    uint32_t& slot = table.find(points[v].data());
    if (slot == table.kFree) slot = v;
    lowest[v] = slot;
  }
  return lowest;
}

std::vector<uint32_t> dropZeroArea(WeldedMesh& mesh, Predicates& predicates) {
  std::vector<uint32_t> dropped;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    if (hasArea(predicates, mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]])) continue;
    mesh.states[t] = TriangleState::zeroArea;
    dropped.push_back(t);
  }
  return dropped;
}

std::vector<Stitch> findStitches(const WeldedMesh& mesh, const std::vector<uint32_t>& zeroArea) {
  struct Use {
    uint32_t low, high, triangle;
    auto key() const { return std::array<uint32_t, 2>{low, high}; }
  };
  std::vector<Use> uses;
  for (const uint32_t t : zeroArea) {
    const auto& v = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = v[i], b = v[(i + 1) % 3];
      if (a != b) uses.push_back({std::min(a, b), std::max(a, b), t});  // a point is on many lines
    }
  }
  std::sort(uses.begin(), uses.end(),
            [](const Use& a, const Use& b) { return a.key() != b.key() ? a.key() < b.key() : a.triangle < b.triangle; });
  const auto indexOf = [&](uint32_t t) { return uint32_t(std::lower_bound(zeroArea.begin(), zeroArea.end(), t) - zeroArea.begin()); };
  DisjointSets lines(zeroArea.size());
  for (size_t i = 1; i < uses.size(); ++i) {
    if (uses[i].key() == uses[i - 1].key()) lines.unite(indexOf(uses[i].triangle), indexOf(uses[i - 1].triangle));
  }
  std::vector<std::vector<uint32_t>> verticesOf(zeroArea.size());  // of each line, at its root
  for (uint32_t i = 0; i < zeroArea.size(); ++i) {
    auto& vertices = verticesOf[lines.find(i)];
    vertices.insert(vertices.end(), mesh.triangles[zeroArea[i]].begin(), mesh.triangles[zeroArea[i]].end());
  }
  const auto before = [&](uint32_t a, uint32_t b) { return mesh.points[a] < mesh.points[b]; };  // lexicographic: the order along a line
  for (auto& vertices : verticesOf) {
    std::sort(vertices.begin(), vertices.end(), before);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
  std::vector<Stitch> stitches;
  for (size_t i = 0; i < uses.size(); ++i) {
    const auto [low, high, triangle] = uses[i];
    if (i > 0 && uses[i].key() == uses[i - 1].key()) continue;
    const auto& line = verticesOf[lines.find(indexOf(triangle))];
    const bool ascending = before(low, high);
    const auto first = std::upper_bound(line.begin(), line.end(), ascending ? low : high, before);
    const auto last = std::lower_bound(line.begin(), line.end(), ascending ? high : low, before);
    if (first >= last) continue;
    stitches.push_back({low, high, std::vector<uint32_t>(first, last)});
    if (!ascending) std::reverse(stitches.back().vertices.begin(), stitches.back().vertices.end());
  }
  return stitches;
}

}  // namespace mandoline::detail
