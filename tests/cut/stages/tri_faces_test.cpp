#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "catch.h"
#include "staged_cut.h"

using namespace stages;

TEST_CASE("A triangle in one grid cell stays whole", "[stages][triFaces]") {
  const StagedCut cut(shapes::triangle({1.25, 1.25, 1.25}, {1.75, 1.25, 1.5}, {1.25, 1.75, 1.5}), Stage::triFaces);
  const TriFaces& faces = cut.brick.triFaces;
  REQUIRE(faces.size() == 1);
  CHECK(faces.elements[{0}] == Slab{3, 3, 3});
  CHECK(faces.loopsOf({0})[0].size() == 3);
  CHECK(cut.brick.faceEdges.empty());
  CHECK_FALSE(faces.touchesLine[{0}]);
}

TEST_CASE("Every piece of a triangle lies in one grid cell, and pieces share hybrid edges", "[stages][triFaces]") {
  const StagedCut cut(shapes::triangle({0.1, 0.2, 0.3}, {2.9, 0.4, 1.7}, {0.6, 2.8, 2.9}), Stage::triFaces);
  const TriFaces& faces = cut.brick.triFaces;
  const CutVertices& vertices = cut.brick.vertices;
  CHECK(faces.size() > 8);
  std::map<std::array<VertexId, 2>, int> uses;
  for (const FaceId f : faces.ids()) {
    const auto loop = faces.loopsOf(f)[0];
    for (size_t i = 0; i < loop.size(); ++i) {
      for (int d = 0; d < 3; ++d) CHECK(std::abs(vertices.slab(loop[i])[d] - faces.elements[f][d]) <= 1);
      const VertexId u = loop[i], v = loop[(i + 1) % loop.size()];
      uses[{std::min(u, v), std::max(u, v)}] += u < v ? 1 : -1;
    }
  }
  std::set<std::array<VertexId, 2>> hybrid;
  for (const FaceEdge& e : cut.brick.faceEdges) {
    CHECK(planeCount(e.element) == 1);
    hybrid.insert({std::min(e.from, e.to), std::max(e.from, e.to)});
  }
  // Hybrid edges have a piece on both sides, the others are on the outline.
  for (const auto& [edge, net] : uses) CHECK((net == 0) == (hybrid.count(edge) == 1));
}

TEST_CASE("A triangle in an axial plane is cut into pieces of grid-faces", "[stages][triFaces]") {
  const StagedCut cut(shapes::triangle({0.5, 0.5, 1}, {1.5, 0.5, 1}, {0.5, 0.75, 1}), Stage::triFaces);
  const TriFaces& faces = cut.brick.triFaces;
  REQUIRE(faces.size() == 2);
  CHECK(faces.elements[{0}] == Slab{1, 1, 2});
  CHECK(faces.elements[{1}] == Slab{3, 1, 2});
}

TEST_CASE("Where a triangle meets a grid line there is one vertex for both hybrid edges", "[stages][triFaces]") {
  const StagedCut cut(shapes::triangle({0.5, 0.5, 0.5}, {1.75, 0.5, 0.5}, {0.5, 1.75, 0.5}), Stage::triFaces);
  const CutVertices& vertices = cut.brick.vertices;
  REQUIRE(vertices.slabs == std::vector<Slab>{{2, 2, 1}});
  CHECK(cut.brick.triFaces.size() == 4);
}

TEST_CASE("Pieces outside the grid are left out", "[stages][triFaces]") {
  const StagedCut cut(shapes::triangle({-1, 0.5, 0.5}, {0.5, 0.25, 0.5}, {0.5, 0.75, 0.5}), Stage::triFaces);
  REQUIRE(cut.brick.triFaces.size() == 1);
  CHECK(cut.brick.triFaces.elements[{0}] == Slab{1, 1, 1});
  CHECK(cut.brick.triFaces.loopsOf({0})[0].size() == 4);
}

TEST_CASE("A triangle is cut alike in halves, plane by plane, and by sweeps", "[stages][triFaces]") {
  const int cells = GENERATE(2, 5, 40);  // across 40 planes, a triangle has more corners than are cut in halves
  const int shift = GENERATE(1, 10);     // small bricks get pieces
  CAPTURE(cells, shift);
  std::mt19937 random(1);
  const auto lattice = [&] { return double(random() % 13) / 4; };  // often in planes and on grid lines
  const double h = 3.0 / cells;
  const Grid grid = Grid::regular({0, 0, 0}, {h, h, h}, {cells, cells, cells});
  Way sweeps;
  sweeps.onlyGeneral = true;
  Way halves;
  halves.brickShift = sweeps.brickShift = shift;
  size_t faces = 0;
  for (int i = 0; i < 40; ++i) {
    const auto corner = [&] { return Point{lattice(), lattice(), lattice()}; };
    const Point a = corner(), b = corner(), c = corner();
    const StagedCut one(shapes::triangle(a, b, c), Stage::triFaces, halves, grid);
    const StagedCut other(shapes::triangle(a, b, c), Stage::triFaces, sweeps, grid);
    const auto &ours = one.brick.triFaces, &theirs = other.brick.triFaces;
    CHECK(ours.loops.items == theirs.loops.items);
    CHECK(ours.loops.offsets == theirs.loops.offsets);
    CHECK(ours.elements == theirs.elements);
    CHECK(ours.touchesLine == theirs.touchesLine);
    CHECK(one.brick.vertices.slabs == other.brick.vertices.slabs);
    CHECK(one.state.surface.vertices.slabs == other.state.surface.vertices.slabs);
    CHECK(std::equal(one.brick.faceEdges.begin(), one.brick.faceEdges.end(), other.brick.faceEdges.begin(), other.brick.faceEdges.end(),
                     [](const FaceEdge& e, const FaceEdge& f) { return e.element == f.element && e.from == f.from && e.to == f.to; }));
    faces += ours.size();
  }
  CHECK(faces > 40);
}
