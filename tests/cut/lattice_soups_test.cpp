// Random triangles with corners on a lattice of 4 x 4 x 4 points, where everything is degenerate, against their arrangement found by brute
// force: the box is divided by the whole planes of all triangles and of the grid, each plane by the whole lines of its triangles' sides,
// all in whole numbers; then the pieces that no triangle and no grid plane separates are put together again and counted.
#include <algorithm>
#include <array>
#include <numeric>
#include <random>

#include "base/disjoint_sets.h"
#include "catch.h"
#include "checked_cut.h"

using namespace mandoline;

namespace {

using Whole = std::array<int64_t, 3>;
/// (x, y, z, w) with w > 0: the point (x, y, z) / w. Planes (a, b, c, d): the points with a x + b y + c z + d w = 0. In lowest terms.
using Four = std::array<int64_t, 4>;

Whole operator-(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Whole cross(const Whole& a, const Whole& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
int64_t height(const Four& plane, const Four& p) { return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3]; }
int signOf(int64_t x) { return (x > 0) - (x < 0); }

Four reduced(Four f) {
  int64_t divisor = 0;
  for (const int64_t x : f) divisor = std::gcd(divisor, x);
  for (int64_t& x : f) x /= divisor;
  return f;
}
/// Through p; the same for both directions of the normal.
Four planeThrough(const Whole& p, Whole normal) {
  const int64_t first = normal[0] != 0 ? normal[0] : normal[1] != 0 ? normal[1] : normal[2];
  if (first < 0) normal = {-normal[0], -normal[1], -normal[2]};
  return reduced({normal[0], normal[1], normal[2], -(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2])});
}

struct Triangle {
  explicit Triangle(const std::array<Whole, 3>& corners) {
    const Whole normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    plane = planeThrough(corners[0], normal);
    for (size_t i = 0; i < 3; ++i) {
      const Whole &a = corners[i], &b = corners[(i + 1) % 3], &c = corners[(i + 2) % 3];
      sides[i] = planeThrough(a, cross(normal, b - a));
      if (height(sides[i], {c[0], c[1], c[2], 1}) > 0) continue;
      for (int64_t& x : sides[i]) x = -x;
    }
  }

  /// Of a point in its plane.
  bool contains(const Four& p) const {
    return std::all_of(sides.begin(), sides.end(), [&](const Four& side) { return height(side, p) >= 0; });
  }

  Four plane;
  std::array<Four, 3> sides;  ///< planes through its sides across its own; the triangle is above them
};

/// Convex cells between convex facets between edges.
class Arrangement {
 public:
  struct Counts {
    size_t cells = 0, regions = 0;
    size_t faces = 0, parents = 0, edges = 0, vertices = 0;  ///< of the triangles
    bool operator==(const Counts&) const = default;
  };

  /// Triangles in the box [0, size]^3, which planes across each axis divide.
  Arrangement(int64_t size, const std::vector<int64_t>& planes, const std::vector<Triangle>& triangles) : triangles_(triangles) {
    makeBox(size);
    for (int d = 0; d < 3; ++d) {
      for (const int64_t x : planes) {
        Whole p = {0, 0, 0}, normal = {0, 0, 0};
        p[size_t(d)] = x;
        normal[size_t(d)] = 1;
        divide(idOf(planeThrough(p, normal), true));
      }
    }
    for (const Triangle& t : triangles) {
      const size_t before = planes_.size();
      const uint32_t plane = idOf(t.plane, false);
      if (planes_.size() > before) divide(plane);
      inPlane_[plane].push_back(uint32_t(&t - &triangles[0]));
    }
    for (uint32_t plane = 0; plane < planes_.size(); ++plane) divideBySides(plane);
    for (Facet& f : facets_) update(f.edges);
  }

  Counts count() {
    findParents();
    Counts counts;
    counts.cells = classes(cells_.size(), [&](uint32_t f) { return facets_[f].parents.empty() && !isAxial_[facets_[f].plane]; });
    counts.regions = classes(cells_.size(), [&](uint32_t f) { return facets_[f].parents.empty(); });
    countSurface(counts);
    return counts;
  }

 private:
  static constexpr uint32_t kNone = ~0u;

  struct Edge {
    std::array<uint32_t, 2> ends;
    std::array<uint32_t, 2> parts = {kNone, kNone};  // that it was divided into
  };
  struct Facet {
    uint32_t plane;
    std::vector<uint32_t> edges;
    std::vector<uint32_t> parents = {};  // triangles that contain it
  };

  uint32_t idOf(const Four& plane, bool axial) {
    const auto known = std::find(planes_.begin(), planes_.end(), plane);
    if (known != planes_.end()) return uint32_t(known - planes_.begin());
    planes_.push_back(plane);
    isAxial_.push_back(axial);
    inPlane_.emplace_back();
    return uint32_t(planes_.size() - 1);
  }

  void makeBox(int64_t size) {
    for (int64_t c = 0; c < 8; ++c) points_.push_back({c & 1 ? size : 0, c & 2 ? size : 0, c & 4 ? size : 0, 1});
    cells_.emplace_back();
    for (uint32_t a = 0; a < 8; ++a) {
      for (uint32_t bit = 1; bit < 8; bit *= 2) {
        if (!(a & bit)) edges_.push_back({{a, a | bit}});
      }
    }
    for (uint32_t d = 0; d < 3; ++d) {
      for (const uint32_t upper : {0u, 1u << d}) {
        Whole normal = {0, 0, 0};
        normal[d] = 1;
        const Four& p = points_[upper];
        Facet facet{idOf(planeThrough({p[0], p[1], p[2]}, normal), true), {}};
        for (uint32_t e = 0; e < edges_.size(); ++e) {
          if ((edges_[e].ends[0] & 1u << d) == upper && (edges_[e].ends[1] & 1u << d) == upper) facet.edges.push_back(e);
        }
        cells_[0].push_back(uint32_t(facets_.size()));
        facets_.push_back(facet);
      }
    }
  }

  /// Replaces edges that were divided by their parts.
  void update(std::vector<uint32_t>& edges) const {
    for (size_t i = 0; i < edges.size();) {
      const std::array<uint32_t, 2> parts = edges_[edges[i]].parts;
      if (parts[0] == kNone) {
        ++i;
      } else {
        edges[i] = parts[0];
        edges.push_back(parts[1]);
      }
    }
  }

  int sideOf(const Four& by, uint32_t point) const { return signOf(height(by, points_[point])); }
  /// Of an edge that is not crossed.
  int sideOfEdge(const Four& by, uint32_t e) const {
    const int side = sideOf(by, edges_[e].ends[0]);
    return side != 0 ? side : sideOf(by, edges_[e].ends[1]);
  }

  /// Divides a facet that a plane crosses; the part in front stays. Returns the part behind.
  uint32_t divideFacet(uint32_t f, const Four& by) {
    std::vector<uint32_t> edges = std::move(facets_[f].edges);
    update(edges);
    for (const uint32_t e : edges) {
      const auto [a, b] = edges_[e].ends;
      const int64_t ha = height(by, points_[a]), hb = height(by, points_[b]);
      if (signOf(ha) * signOf(hb) >= 0) continue;
      Four p;
      for (size_t i = 0; i < 4; ++i) p[i] = std::abs(hb) * points_[a][i] + std::abs(ha) * points_[b][i];
      const uint32_t between = uint32_t(points_.size()), first = uint32_t(edges_.size());
      points_.push_back(reduced(p));
      edges_[e].parts = {first, first + 1};
      edges_.push_back({{a, between}});
      edges_.push_back({{between, b}});
    }
    update(edges);
    std::array<std::vector<uint32_t>, 2> parts;  // in front, behind
    for (auto& part : parts) part.reserve(edges.size());
    std::array<uint32_t, 2> cut = {kNone, kNone};
    for (const uint32_t e : edges) {
      const int side = sideOfEdge(by, e);
      if (side != 0) parts[side < 0].push_back(e);
      for (const uint32_t v : edges_[e].ends) {
        if (sideOf(by, v) == 0 && v != cut[0]) cut[cut[0] != kNone] = v;
      }
    }
    for (auto& part : parts) part.push_back(uint32_t(edges_.size()));
    edges_.push_back({cut});
    facets_[f].edges = std::move(parts[0]);
    facets_.push_back({facets_[f].plane, std::move(parts[1])});
    return uint32_t(facets_.size() - 1);
  }

  /// The sides of a plane that points lie on, by the least and the greatest of them.
  struct Span {
    int least = 0, greatest = 0;
    void include(int side) {
      least = std::min(least, side);
      greatest = std::max(greatest, side);
    }
    bool isCrossed() const { return least < 0 && greatest > 0; }
  };

  bool isCrossed(const Facet& facet, const Four& by) const {
    Span span;
    for (const uint32_t e : facet.edges) span.include(sideOf(by, edges_[e].ends[0])), span.include(sideOf(by, edges_[e].ends[1]));
    return span.isCrossed();
  }

  /// Divides all cells.
  void divide(uint32_t plane) {
    const Four by = planes_[plane];
    const size_t oldCells = cells_.size();
    std::vector<int> sides(points_.size());
    for (uint32_t v = 0; v < points_.size(); ++v) sides[v] = sideOf(by, v);
    std::vector<Span> spans(facets_.size());
    for (uint32_t f = 0; f < spans.size(); ++f) {
      for (const uint32_t e : facets_[f].edges) spans[f].include(sides[edges_[e].ends[0]]), spans[f].include(sides[edges_[e].ends[1]]);
    }
    std::vector<uint32_t> behind(spans.size(), kNone);
    for (uint32_t f = 0; f < spans.size(); ++f) {
      if (spans[f].isCrossed()) behind[f] = divideFacet(f, by);
    }
    for (uint32_t c = 0; c < oldCells; ++c) {
      Span span;
      for (const uint32_t f : cells_[c]) span.include(spans[f].least), span.include(spans[f].greatest);
      if (span.isCrossed()) divideCell(c, plane, spans, behind);
    }
  }

  void divideCell(uint32_t c, uint32_t plane, const std::vector<Span>& spans, const std::vector<uint32_t>& behind) {
    std::array<std::vector<uint32_t>, 2> parts;  // in front, behind
    for (auto& part : parts) part.reserve(cells_[c].size() + 1);
    std::vector<uint32_t> section;
    section.reserve(2 * cells_[c].size());
    for (const uint32_t f : cells_[c]) {
      if (spans[f].greatest > 0) parts[0].push_back(f);
      if (spans[f].least < 0) parts[1].push_back(behind[f] == kNone ? f : behind[f]);
      for (const uint32_t e : facets_[f].edges) {
        if (sideOfEdge(planes_[plane], e) == 0) section.push_back(e);
      }
    }
    std::sort(section.begin(), section.end());
    section.erase(std::unique(section.begin(), section.end()), section.end());
    for (auto& part : parts) part.push_back(uint32_t(facets_.size()));
    facets_.push_back({plane, section});
    cells_[c] = std::move(parts[0]);
    cells_.push_back(std::move(parts[1]));
  }

  /// Divides a plane's facets, and no cells.
  void divideBySides(uint32_t plane) {
    std::vector<Four> sides;
    for (const uint32_t t : inPlane_[plane]) sides.insert(sides.end(), triangles_[t].sides.begin(), triangles_[t].sides.end());
    if (behind_.size() < facets_.size()) behind_.resize(facets_.size());
    std::vector<uint32_t> pieces;  // with the facet that each comes from
    for (uint32_t f = 0, all = uint32_t(facets_.size()); f < all; ++f) {
      if (facets_[f].plane != plane) continue;
      pieces = {f};
      for (const Four& by : sides) {
        for (size_t i = 0, n = pieces.size(); i < n; ++i) {
          if (isCrossed(facets_[pieces[i]], by)) pieces.push_back(divideFacet(pieces[i], by));
        }
      }
      behind_[f].assign(pieces.begin() + 1, pieces.end());
    }
  }

  void findParents() {
    for (Facet& f : facets_) {
      for (const uint32_t t : inPlane_[f.plane]) {
        const bool contained = std::all_of(f.edges.begin(), f.edges.end(), [&](uint32_t e) {
          return triangles_[t].contains(points_[edges_[e].ends[0]]) && triangles_[t].contains(points_[edges_[e].ends[1]]);
        });
        if (contained) f.parents.push_back(t);
      }
    }
  }

  /// How many classes cells make that are joined through facets.
  template <class IsOpen>
  size_t classes(size_t n, const IsOpen& isOpen) const {
    detail::DisjointSets sets(n);
    std::vector<uint32_t> first(facets_.size(), kNone);
    size_t count = n;
    const auto join = [&](uint32_t c, uint32_t f) {
      if (first[f] == kNone) {
        first[f] = c;
      } else if (isOpen(f) && sets.find(c) != sets.find(first[f])) {
        sets.unite(c, first[f]);
        --count;
      }
    };
    for (uint32_t c = 0; c < n; ++c) {
      for (const uint32_t f : cells_[c]) {
        join(c, f);
        if (f < behind_.size()) {
          for (const uint32_t g : behind_[f]) join(c, g);
        }
      }
    }
    return count;
  }

  /// Whether an edge between facets belongs to the arrangement: not in the midst of one face.
  bool isReal(const std::vector<uint32_t>& around) const {
    std::vector<uint32_t> solid;  // facets that separate cells
    for (const uint32_t f : around) {
      if (isAxial_[facets_[f].plane] || !facets_[f].parents.empty()) solid.push_back(f);
    }
    if (solid.empty()) return false;
    return solid.size() != 2 || facets_[solid[0]].plane != facets_[solid[1]].plane ||
           facets_[solid[0]].parents != facets_[solid[1]].parents;
  }

  void countSurface(Counts& counts) const {
    std::vector<std::vector<uint32_t>> facetsAt(edges_.size()), edgesAt(points_.size());
    for (uint32_t f = 0; f < facets_.size(); ++f) {
      counts.faces += !facets_[f].parents.empty();
      counts.parents += facets_[f].parents.size();
      for (const uint32_t e : facets_[f].edges) facetsAt[e].push_back(f);
    }
    detail::DisjointSets faces(facets_.size());
    std::vector<uint8_t> onSurface(points_.size(), 0);
    for (uint32_t e = 0; e < edges_.size(); ++e) {
      const auto& around = facetsAt[e];
      bool surface = false;
      for (const uint32_t f : around) surface |= !facets_[f].parents.empty();
      if (isReal(around)) {
        for (const uint32_t v : edges_[e].ends) {
          edgesAt[v].push_back(e);
          onSurface[v] |= surface;
        }
        counts.edges += surface;
      } else if (surface) {
        uint32_t f = kNone;
        for (const uint32_t g : around) {
          if (facets_[g].parents.empty()) continue;
          if (f != kNone && faces.find(f) != faces.find(g)) {
            faces.unite(f, g);
            --counts.faces;
            counts.parents -= facets_[g].parents.size();
          }
          f = g;
        }
      }
    }
    for (uint32_t v = 0; v < points_.size(); ++v) {
      if (!onSurface[v]) continue;
      const bool passed = edgesAt[v].size() == 2 && areOnLine(v, otherEnd(edgesAt[v][0], v), otherEnd(edgesAt[v][1], v));
      counts.vertices += !passed;
      counts.edges -= passed;
    }
  }

  uint32_t otherEnd(uint32_t e, uint32_t v) const { return edges_[e].ends[edges_[e].ends[0] == v]; }
  bool areOnLine(uint32_t a, uint32_t b, uint32_t c) const {  // the rank of their coordinates is 2: all minors vanish
    const Four &p = points_[a], &q = points_[b], &r = points_[c];
    for (size_t leave = 0; leave < 4; ++leave) {
      const size_t i = leave == 0, j = leave <= 1 ? 2 : 1, k = leave <= 2 ? 3 : 2;
      __int128 minor = 0;
      minor += __int128(p[i]) * (q[j] * r[k] - q[k] * r[j]);
      minor -= __int128(p[j]) * (q[i] * r[k] - q[k] * r[i]);
      minor += __int128(p[k]) * (q[i] * r[j] - q[j] * r[i]);
      if (minor != 0) return false;
    }
    return true;
  }

  const std::vector<Triangle>& triangles_;
  std::vector<Four> points_, planes_;
  std::vector<uint8_t> isAxial_;
  std::vector<std::vector<uint32_t>> inPlane_;  // per plane: its triangles
  std::vector<Edge> edges_;
  std::vector<Facet> facets_;
  std::vector<std::vector<uint32_t>> cells_;   // facets
  std::vector<std::vector<uint32_t>> behind_;  // per facet: others that were divided off it, on the same cells
};

constexpr int64_t kScale = 4;  // so that the planes of 3 and 4 cells lie at whole numbers

std::vector<Triangle> wholeTriangles(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<Whole, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t d = 0; d < 3; ++d) corners[i][d] = kScale * int64_t(mesh.positions[3 * mesh.triangles[3 * t + i] + d]);
    }
    triangles.emplace_back(corners);
  }
  return triangles;
}

Arrangement::Counts bruteForce(const Mesh& mesh, int64_t n) {
  std::vector<int64_t> planes;
  for (int64_t c = 1; c < n; ++c) planes.push_back(3 * kScale * c / n);
  const std::vector<Triangle> triangles = wholeTriangles(mesh);
  return Arrangement(3 * kScale, planes, triangles).count();
}

Arrangement::Counts countsOf(const CheckedCut& cut) {
  const CutMesh& mesh = cut.mesh;
  Arrangement::Counts counts;
  counts.cells = cut.cells();
  counts.regions = mesh.regionCount;
  std::vector<uint32_t> vertices;
  std::vector<std::array<uint32_t, 2>> edges;
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    if (mesh.faceTriangle[f] < 0) continue;
    ++counts.faces;
    counts.parents += mesh.faceParentOffsets[f + 1] - mesh.faceParentOffsets[f];
    for (const auto loop : mesh.loops(f)) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const auto [low, high] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
        edges.push_back({low, high});
        vertices.push_back(loop[i]);
      }
    }
  }
  const auto distinct = [](auto& items) {
    std::sort(items.begin(), items.end());
    return size_t(std::unique(items.begin(), items.end()) - items.begin());
  };
  counts.edges = distinct(edges);
  counts.vertices = distinct(vertices);
  return counts;
}

void compare(const Mesh& mesh, int64_t n) {
  const Arrangement::Counts expected = bruteForce(mesh, n);
  const Arrangement::Counts found = countsOf(checkedCut(mesh, Grid::box({0, 0, 0}, {3, 3, 3}, {n, n, n})));
  CHECK(found.cells == expected.cells);
  CHECK(found.regions == expected.regions);
  CHECK(found.faces == expected.faces);
  CHECK(found.parents == expected.parents);
  CHECK(found.edges == expected.edges);
  CHECK(found.vertices == expected.vertices);
}

Mesh randomTriangles(unsigned seed, uint32_t count) {
  std::mt19937 random(seed);
  Mesh mesh;
  while (mesh.triangleCount() < count) {
    std::array<Whole, 3> corners;
    for (Whole& corner : corners) {
      for (int64_t& x : corner) x = int64_t(random() % 4);
    }
    if (cross(corners[1] - corners[0], corners[2] - corners[0]) == Whole{0, 0, 0}) continue;  // it would leave vertices on others' sides
    for (const Whole& corner : corners) {
      mesh.triangles.push_back(uint32_t(mesh.vertexCount()));
      mesh.positions.insert(mesh.positions.end(), {double(corner[0]), double(corner[1]), double(corner[2])});
    }
  }
  return mesh;
}

#ifdef __EMSCRIPTEN__
constexpr unsigned kSeeds = 40;  // WebAssembly takes most of its time for the brute force, which is the same there
#else
constexpr unsigned kSeeds = 200;
#endif

void compareSoups(int64_t n, uint32_t triangles) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    INFO(triangles << " triangles, seed " << seed << ", N = " << n);
    compare(randomTriangles(seed, triangles), n);
  }
}

}  // namespace

TEST_CASE("lattice soups: the brute force counts what is known", "[latticesoups]") {
  const Mesh cross{{0, 1, 0, 3, 1, 0, 3, 1, 3, 0, 1, 3, 0, 0, 2, 3, 0, 2, 3, 3, 2, 0, 3, 2}, {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}};
  const Arrangement::Counts counts = bruteForce(cross, 1);  // two squares across the box
  CHECK(counts.cells == 4);
  CHECK(counts.regions == 4);
  CHECK(counts.faces == 8);  // each square's diagonal crosses the other square
  CHECK(counts.vertices == 8 + 2 + 2);
  CHECK(counts.parents == 8);
}

TEST_CASE("lattice soups: eight triangles", "[latticesoups]") {
  for (const int64_t n : {1, 3, 4}) compareSoups(n, 8);
}
TEST_CASE("lattice soups: sixty triangles in one cell", "[latticesoups]") { compareSoups(1, 60); }
TEST_CASE("lattice soups: sixty triangles in 3x3x3 cells", "[latticesoups]") { compareSoups(3, 60); }
TEST_CASE("lattice soups: sixty triangles in 4x4x4 cells", "[latticesoups]") { compareSoups(4, 60); }
