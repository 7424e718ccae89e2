#include "mesh/welded_mesh.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/position_table.h"
#include "base/sort.h"

namespace mandoline::detail {

std::span<const Duplicate> WeldedMesh::duplicatesOf(TriangleId t) const {
  if (duplicates.empty()) return {};
  const auto [first, past] = std::equal_range(duplicates.begin(), duplicates.end(), Duplicate{t.number, 0, false},
                                              [](const Duplicate& a, const Duplicate& b) { return a.original < b.original; });
  return {duplicates.data() + (first - duplicates.begin()), size_t(past - first)};
}

const Stitch* WeldedMesh::findStitch(uint32_t low, uint32_t high) const {
  const auto at =
      std::lower_bound(stitches.begin(), stitches.end(), std::array<uint32_t, 2>{low, high}, [](const Stitch& s, const auto& key) {
        return std::array<uint32_t, 2>{s.low, s.high} < key;
      });
  return at != stitches.end() && at->low == low && at->high == high ? &*at : nullptr;
}

int normalSign(const WeldedMesh& mesh, TriangleId triangle, int axis, Predicates& predicates) {
  const auto& t = mesh.triangles[triangle.number];
  const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
  const size_t p = size_t(axis + 1) % 3, q = size_t(axis + 2) % 3;
  return predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]});
}

namespace {

/// Whether it is sure, in doubles, that a triangle has area.
bool surelyHasArea(const WeldedMesh& mesh, const std::array<uint32_t, 3>& triangle) {
  const Point &a = mesh.points[triangle[0]], &b = mesh.points[triangle[1]], &c = mesh.points[triangle[2]];
  for (size_t d = 0; d < 3; ++d) {
    const size_t p = (d + 1) % 3, q = (d + 2) % 3;
    const Point2 x{a[p], a[q]}, y{b[p], b[q]}, z{c[p], c[q]};
    if (surelyTurnsLeft(x, y, z) || surelyTurnsLeft(y, x, z)) return true;
  }
  return false;
}

}  // namespace

std::vector<uint32_t> weld(const std::vector<uint8_t>& referenced, const std::vector<Point>& points) {
  return lowestAtPosition(
      points.size(), [&](uint32_t v) { return points[v].data(); }, [&](uint32_t v) { return referenced[v] != 0; });
}

std::vector<uint32_t> dropZeroArea(WeldedMesh& mesh, const std::vector<uint32_t>* some, Monitor& monitor, Predicates& predicates) {
  constexpr size_t kBlock = 1 << 13;  // triangles that are worth a thread
  struct Chunk {
    std::vector<uint32_t> dropped;
    Predicates predicates;
  };
  const auto chunks = forChunks<Chunk>(
      some ? some->size() : mesh.triangles.size(), monitor,
      [&](Chunk& chunk, size_t begin, size_t end) {
        Predicates& exact = chunk.predicates;
        for (size_t i = begin; i < end; ++i) {
          const TriangleId t{some ? (*some)[i] : uint32_t(i)};
          if (surelyHasArea(mesh, mesh.triangles[t.number])) continue;
          if (normalSign(mesh, t, 0, exact) || normalSign(mesh, t, 1, exact) || normalSign(mesh, t, 2, exact)) continue;
          mesh.states[t.number] = TriangleState::zeroArea;
          chunk.dropped.push_back(t.number);
        }
      },
      kBlock);
  std::vector<uint32_t> dropped;
  for (const Chunk& chunk : chunks) {
    dropped.insert(dropped.end(), chunk.dropped.begin(), chunk.dropped.end());
    predicates.fallbacks += chunk.predicates.fallbacks;
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
  sortItems(uses, [](const Use& a, const Use& b) { return a.key() != b.key() ? a.key() < b.key() : a.triangle < b.triangle; });
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
  for (auto& vertices : verticesOf) sortUnique(vertices, before);
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
