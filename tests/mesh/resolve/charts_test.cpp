// Which pairs of triangles need not be looked at: the charts of a mesh, and the tree that leaves out pairs within them.
#include "mesh/resolve/charts.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "base/box_tree.h"
#include "base/group_numbers.h"
#include "catch.h"
#include "mesh/prepared.h"
#include "mesh/resolve/contacts.h"
#include "mesh/resolve/triangle_tree.h"
#include "shapes.h"
#include "staged_cut.h"

using namespace mandoline;
using namespace mandoline::detail;

namespace {

using Pairs = std::set<std::array<uint32_t, 2>>;

const Grid kGrid = Grid::regular({-64, -64, -64}, {32, 32, 32}, {4, 4, 4});

/// A mesh before anybody has looked for intersections.
struct Unresolved : stages::StagedCut {
  const Prepared& welded = *prepared;
  const SortedMesh sorted{welded};
  const Charts charts = findCharts(sorted, monitor);

  explicit Unresolved(const Mesh& mesh) : StagedCut(mesh, stages::Stage::input, stages::unresolved(), kGrid) {}
};

/// Few vertices on a lattice and many triangles between them: they share vertices and sides, cross, overlap and fold.
Mesh tangle(uint32_t seed, int size, int vertices, int triangles) {
  std::mt19937 random(seed);
  Mesh mesh;
  for (int i = 0; i < 3 * vertices; ++i) mesh.positions.push_back(double(random() % uint32_t(size)));
  for (int i = 0; i < 3 * triangles; ++i) mesh.triangles.push_back(random() % uint32_t(vertices));
  return mesh;
}

/// A sheet on a lattice, some coordinates of which are moved.
Mesh crumpled(uint32_t seed, int moved) {
  std::mt19937 random(seed);
  Mesh mesh = shapes::sheet(8, 8, [&](int i, int j) { return shapes::Point{double(i), double(j), double(random() % 2)}; });
  for (int i = 0; i < moved; ++i) mesh.positions[random() % mesh.positions.size()] += double(random() % 5) - 2;
  return mesh;
}

std::vector<Mesh> tangles() {
  std::vector<Mesh> meshes;
  for (uint32_t seed = 0; seed < 150; ++seed) {
    meshes.push_back(tangle(seed, seed % 2 ? 3 : 6, 6 + int(seed % 7), 8 + int(seed % 20)));
    meshes.push_back(crumpled(seed, int(seed % 30)));
  }
  return meshes;
}

std::array<uint32_t, 2> ascending(uint32_t s, uint32_t t) { return {std::min(s, t), std::max(s, t)}; }

}  // namespace

TEST_CASE("sorted mesh: copies of a triangle are left out, whether they are known or not", "[resolve]") {
  for (Mesh mesh : tangles()) {
    const size_t all = mesh.triangles.size();
    for (size_t i = 0; i < all; i += 3) {  // copies of every triangle, turned either way
      const auto [a, b, c] = std::array{mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]};
      if (i % 2 == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {b, c, a});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {b, a, c});
      }
    }
    const Unresolved known(mesh);
    std::vector<TriangleState> states = known.welded.states;
    std::replace(states.begin(), states.end(), TriangleState::duplicate, TriangleState::kept);
    const SortedMesh unknown(known.welded, states);
    CHECK(unknown.ids == known.sorted.ids);
    CHECK(unknown.triangles == known.sorted.triangles);
  }
}

TEST_CASE("charts: triangles of one have nothing in common but shared vertices and sides", "[charts]") {
  size_t together = 0, meeting = 0;
  for (const Mesh& mesh : tangles()) {
    const Unresolved unresolved(mesh);
    const SortedMesh& sorted = unresolved.sorted;
    PairTest pairs(unresolved.welded);
    for (uint32_t i = 0; i < sorted.ids.size(); ++i) {
      for (uint32_t j = i + 1; j < sorted.ids.size(); ++j) {
        const bool meet = pairs.meet(sorted.ids[i], sorted.ids[j]);
        const bool inOne = unresolved.charts.chartOf[i] == unresolved.charts.chartOf[j];
        together += inOne;
        meeting += meet;
        REQUIRE((!inOne || !meet));
      }
    }
  }
  CHECK(together > 50000);
  CHECK(meeting > 4000);
}

TEST_CASE("charts: large meshes have the same for any number of threads", "[charts]") {
  const auto flat = [](int i, int j) { return shapes::Point{double(i), double(j), 0}; };
  const Unresolved sheet(shapes::sheet(160, 160, flat)), ball(shapes::icosphere({0, 0, 0}, 1, 6));
  CHECK(sheet.charts.count < 20);  // of 51200 triangles, in two ranges
  CHECK(ball.charts.count < 400);  // of 81920, in three
  for (const Unresolved* mesh : {&sheet, &ball}) {
    for (const unsigned threads : {1u, 2u, 3u}) {
      CutOptions options;
      options.threads = threads;
      Monitor monitor(options, 1);
      const Charts charts = findCharts(mesh->sorted, monitor);
      CHECK(charts.count == mesh->charts.count);
      CHECK(charts.chartOf == mesh->charts.chartOf);
    }
  }
}

TEST_CASE("charts: a smooth or flat surface has few", "[charts]") {
  CHECK(Unresolved(shapes::icosphere({0, 0, 0}, 1, 4)).charts.count < 40);  // of 5120 triangles
  CHECK(Unresolved(shapes::sheet(40, 40, [](int i, int j) { return shapes::Point{double(i), double(j), 0}; })).charts.count == 1);
  CHECK(Unresolved(shapes::sheet(40, 40, [](int i, int j) {
          return shapes::Point{double(i), double(i + j), double(j - 2 * i)};
        })).charts.count == 1);
}

TEST_CASE("charts: triangles without neighbours are alone", "[charts]") {
  Mesh mesh;
  for (int i = 0; i < 30; ++i) {
    const double x = 3 * i;
    for (const double p : {x, 0.0, 0.0, x + 2, 0.0, 1.0, x + 1, 1.0, 0.0}) mesh.positions.push_back(p);
    for (const uint32_t v : {0u, 1u, 2u}) mesh.triangles.push_back(3 * uint32_t(i) + v);
  }
  CHECK(Unresolved(mesh).charts.count == 30);
}

TEST_CASE("charts: a winding staircase that comes to lie above itself is several", "[charts]") {
  constexpr int kSteps = 96;  // six times around
  const Mesh stairs = shapes::sheet(kSteps, 2, [](int i, int j) {
    const double angle = M_PI / 8 * i;
    return shapes::Point{(3 - j) * std::cos(angle), (3 - j) * std::sin(angle), i * 0.125};
  });
  const Unresolved unresolved(stairs);
  CHECK(unresolved.charts.count >= 6);
  CHECK(unresolved.charts.count <= kSteps);
}

TEST_CASE("contacts: the pairs that are found are all that meet", "[charts]") {
  for (const Mesh& mesh : tangles()) {
    const Unresolved unresolved(mesh);
    const Prepared& welded = unresolved.welded;
    PairTest test(welded);
    PairContact pair;
    Pairs expected, found;
    for (uint32_t s = 0; s < welded.triangles.size(); ++s) {
      for (uint32_t t = s + 1; t < welded.triangles.size(); ++t) {
        if (welded.kept(s) && welded.kept(t) && test.find(s, t, pair)) expected.insert({s, t});
      }
    }
    CutOptions options;
    Monitor monitor(options, 1);
    Predicates predicates;
    for (const PairContact& contact : findContacts(welded, findNear(SortedMesh(welded), monitor), monitor, predicates).pairs) {
      CHECK(found.insert({contact.triangles[0], contact.triangles[1]}).second);
    }
    REQUIRE(found == expected);
  }
}

TEST_CASE("triangle tree: gives all pairs of different groups whose boxes overlap, once, and no others but within a rounding", "[charts]") {
  for (const uint32_t groups : {1u, 2u, 7u, 300u}) {
    const Unresolved unresolved(tangle(groups, 9, 60, 300));
    const SortedMesh& sorted = unresolved.sorted;
    std::mt19937 random(groups);
    std::vector<uint32_t> groupOf(sorted.triangles.size());
    for (uint32_t& group : groupOf) group = random() % groups;
    const auto boxOf = [&](uint32_t t, double room) {
      Box box{sorted.points[sorted.triangles[t][0]], sorted.points[sorted.triangles[t][0]]};
      for (const uint32_t v : sorted.triangles[t]) {
        for (const double sign : {-1., 1.}) {
          Point p = sorted.points[v];
          for (double& x : p) x += sign * room * std::fabs(x);
          box.include({p, p});
        }
      }
      return box;
    };
    Pairs expected, allowed, found;
    for (uint32_t i = 0; i < groupOf.size(); ++i) {
      for (uint32_t j = i + 1; j < groupOf.size(); ++j) {
        if (groupOf[i] == groupOf[j]) continue;
        if (boxOf(i, 0).overlaps(boxOf(j, 0))) expected.insert({i, j});
        if (boxOf(i, 0x1p-22).overlaps(boxOf(j, 0x1p-22))) allowed.insert({i, j});
      }
    }
    for (const unsigned threads : {1u, 3u}) {
      RunOptions options;
      options.threads = threads;
      Monitor monitor(options, 1);
      const Csr<uint32_t> byGroup = groupNumbers(groups, groupOf.size(), monitor, [&](size_t t) { return groupOf[t]; });
      const TriangleTree tree(sorted, groupOf, byGroup, monitor);
      found.clear();
      for (const TriangleTree::LeafPair& leaves : tree.overlappingLeaves(monitor)) {
        tree.forOverlapping(leaves, [&](uint32_t i, uint32_t j) { CHECK(found.insert(ascending(i, j)).second); });
      }
      CHECK(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
      CHECK(std::includes(allowed.begin(), allowed.end(), found.begin(), found.end()));
    }
    CHECK((groups == 1 || !expected.empty()));
  }
}
