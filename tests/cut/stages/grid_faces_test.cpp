#include <algorithm>
#include <random>

#include "case_list.h"
#include "catch.h"
#include "cut/stages/chains.h"
#include "cut/stages/one_chain.h"
#include "staged_cut.h"

using namespace stages;

namespace {

/// The pieces of the one grid-face that has more than one loop or piece, as loops per piece.
std::vector<size_t> loopsOfPieces(const StagedCut& cut, GridFaceId gridFace) {
  std::vector<size_t> counts;
  for (const HalfFace h : cut.gridFaces.halfFaces[gridFace]) counts.push_back(cut.faces().loops(h.face()).size());
  return counts;
}

/// The grid-face across z at plane 1 of the grid cells (1, 1, ...).
GridFaceId middleFace(const Stencil& stencil) {
  for (const GridCellId c : stencil.cells.ids()) {
    if (stencil.cells[c].element == Slab{3, 3, 1}) return stencil.cells[c].faces[cellFace(2, 1)];
  }
  FAIL("the grid cell is not in the stencil");
  return {};
}

}  // namespace

TEST_CASE("Grid-faces that nothing passes stay whole", "[stages][gridFaces]") {
  const StagedCut cut(shapes::octahedron({1.5, 1.5, 1.5}, 0.25), Stage::gridFaces);
  CHECK(cut.gridFaces.size() == 6);
  for (const GridFaceId g : cut.stencil.faces.ids()) {
    CHECK(loopsOfPieces(cut, g) == std::vector<size_t>{1});
    CHECK(cut.faces().loops(cut.gridFaces.halfFaces[g][0].face())[0].size() == 4);
  }
}

TEST_CASE("A tunnel leaves a face with a hole and a face in it", "[stages][gridFaces]") {
  const StagedCut cut(shapes::octahedron({1.5, 1.5, 1}, 0.25), Stage::gridFaces);
  std::vector<size_t> loops = loopsOfPieces(cut, middleFace(cut.stencil));
  std::sort(loops.begin(), loops.end());
  CHECK(loops == std::vector<size_t>{1, 2});
}

TEST_CASE("The end of a sheet leaves a slit", "[stages][gridFaces]") {
  const StagedCut cut(shapes::triangle({1.25, 1.5, 0.5}, {1.75, 1.5, 0.5}, {1.5, 1.5, 1.5}), Stage::gridFaces);
  const GridFaceId face = middleFace(cut.stencil);
  CHECK(loopsOfPieces(cut, face) == std::vector<size_t>{1});
  CHECK(cut.gridFaces.slits[face].size() == 1);
}

TEST_CASE("A triangle in a grid-face takes the place of that piece", "[stages][gridFaces]") {
  const StagedCut cut(shapes::triangle({1.25, 1.25, 1}, {1.75, 1.25, 1}, {1.25, 1.75, 1}), Stage::gridFaces);
  const GridFaceId face = middleFace(cut.stencil);
  const auto halfFaces = cut.gridFaces.halfFaces[face];
  REQUIRE(halfFaces.size() == 2);
  CHECK(cut.faces().isTri(halfFaces[0].face()));
  CHECK(cut.faces().triangle(halfFaces[0].face()) == TriangleId{0});
  CHECK(halfFaces[0].side() == 0);  // the normal is +z, out of the cell below
  CHECK_FALSE(cut.faces().isTri(halfFaces[1].face()));
  CHECK_FALSE(cut.faces().triangle(halfFaces[1].face()));
  CHECK(cut.faces().loops(halfFaces[1].face()).size() == 2);
}

TEST_CASE("Chains give the same pieces as planar graphs", "[stages][gridFaces]") {
  size_t pieces = 0;
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name);
    Way onlyGeneral;
    onlyGeneral.onlyGeneral = true;
    const StagedCut quick(one.mesh, Stage::gridFaces, one.grid), general(one.mesh, Stage::gridFaces, onlyGeneral, one.grid);
    const GridFaces &a = quick.gridFaces, &b = general.gridFaces;
    CHECK(a.loops.offsets == b.loops.offsets);
    CHECK(a.loops.items == b.loops.items);
    CHECK(a.faceLoopOffsets == b.faceLoopOffsets);
    CHECK(a.gridFaces == b.gridFaces);
    CHECK(a.halfFaces.offsets == b.halfFaces.offsets);
    CHECK(a.halfFaces.items == b.halfFaces.items);
    CHECK(a.slits.offsets == b.slits.offsets);
    pieces += a.size();
  }
  CHECK(pieces > 10000);
}

namespace {

/// A square whose corners are the vertices 0 to 3, and edges inside.
bool areChains(const std::vector<std::array<uint32_t, 2>>& edges, Chains& chains) {
  std::vector<GraphVertex> ends;
  uint32_t vertices = 4;
  for (uint32_t i = 0; i < 4; ++i) ends.insert(ends.end(), {{i}, {(i + 1) % 4}});
  for (const auto& [a, b] : edges) {
    ends.insert(ends.end(), {{a}, {b}});
    vertices = std::max({vertices, a + 1, b + 1});
  }
  return chains.trace(4, ends, vertices);
}

}  // namespace

TEST_CASE("Chains say where they are not enough", "[stages][gridFaces]") {
  Chains chains;
  CHECK(areChains({{0, 4}, {5, 4}, {5, 2}}, chains));
  REQUIRE(chains.loops.size() == 2);
  const auto loop = [&](size_t i) {
    std::vector<uint32_t> ids;
    for (const GraphVertex v : chains.loops[i]) ids.push_back(v.number);
    return ids;
  };
  CHECK(loop(0) == std::vector<uint32_t>{0, 1, 2, 5, 4});
  CHECK(loop(1) == std::vector<uint32_t>{2, 3, 0, 4, 5});
  CHECK_FALSE(areChains({{0, 4}}, chains));                          // ends inside
  CHECK_FALSE(areChains({{4, 5}, {5, 6}, {6, 4}}, chains));          // floats
  CHECK_FALSE(areChains({{0, 2}, {4, 5}, {5, 6}, {6, 4}}, chains));  // floats beside a chain
  CHECK_FALSE(areChains({{0, 2}, {1, 3}}, chains));                  // cross
  CHECK_FALSE(areChains({{0, 2}, {0, 3}}, chains));                  // share a vertex of the outline
  CHECK_FALSE(areChains({{0, 4}, {4, 2}, {4, 3}}, chains));          // meet inside
  CHECK_FALSE(areChains({{0, 1}}, chains));                          // along the outline
}

TEST_CASE("One chain gives what chains give, or is not found", "[stages][gridFaces]") {
  const std::vector<VertexId> outline{{70}, {6}, {2}, {9}, {66}};  // some with the same bits below 64, as with vertices inside
  constexpr uint32_t kFirstInside = 128;
  std::mt19937 random(1);
  std::array<size_t, OneChain::kMostEdges + 1> found{};
  size_t others = 0;
  for (int round = 0; round < 20000; ++round) {
    const uint32_t most = random() % 5, sides = uint32_t(outline.size());
    std::vector<uint32_t> way{uint32_t(random() % sides)};  // numbers as in a PlanarGraph: mostly a chain
    uint32_t inside = 0;
    for (uint32_t i = 0; i < most; ++i) way.push_back(sides + (random() % 16 > 0 || inside == 0 ? inside++ : random() % inside));
    way.push_back(random() % 16 > 0 || inside == 0 ? random() % sides : sides);
    std::vector<std::array<uint32_t, 2>> edges;
    for (size_t i = 1; i < way.size(); ++i) edges.push_back({way[i - 1], way[i]});
    if (random() % 16 == 0) edges.push_back({uint32_t(random() % sides), uint32_t(random() % sides)});
    std::shuffle(edges.begin(), edges.end(), random);
    std::vector<GraphVertex> ends;
    std::vector<EdgeOnFace> onFace;
    for (uint32_t i = 0; i < sides; ++i) ends.insert(ends.end(), {{i}, {(i + 1) % sides}});
    const auto idOf = [&](uint32_t v) { return v < sides ? outline[v] : VertexId{kFirstInside + v}; };
    for (auto& [a, b] : edges) {
      if (random() % 2 == 0) std::swap(a, b);
      ends.insert(ends.end(), {{a}, {b}});
      onFace.push_back({idOf(a), idOf(b)});
    }
    OneChain one;
    Chains chains;
    const bool isOne = one.find(outline, onFace), areMany = chains.trace(sides, ends, sides + inside);
    if (!isOne) {
      others += areMany && chains.loops.size() == 2;
      for (uint32_t last = 1; last < sides; ++last) REQUIRE_FALSE(one.findBetween({uint32_t(random() % last), last}, outline, onFace));
      continue;
    }
    const std::array<uint32_t, 2> places{one.first, one.last};
    REQUIRE_FALSE(one.findBetween({places[0], places[1] - 1}, outline, onFace));
    REQUIRE(one.findBetween(places, outline, onFace));
    REQUIRE(areMany);
    REQUIRE(chains.loops.size() == 2);
    ++found[edges.size()];
    for (uint32_t piece = 0; piece < 2; ++piece) {
      std::vector<VertexId> loop, expected;
      one.forLoop(piece, outline, edges.size(), [&](const VertexId* from, size_t count) { loop.insert(loop.end(), from, from + count); });
      for (const GraphVertex v : chains.loops[piece]) expected.push_back(idOf(v.number));
      REQUIRE(loop == expected);
    }
    for (uint32_t side = 0; side < sides; ++side)
      REQUIRE(chains.beside[2 * side] == (side >= one.first && side < one.last ? one.between : one.other));
    for (size_t e = 0; e < edges.size(); ++e) REQUIRE(chains.beside[2 * (sides + e)] == (one.runsToLast[e] ? one.other : one.between));
  }
  CHECK(others == 0);
  for (size_t edges = 1; edges <= 5; ++edges) CHECK(found[edges] > 1000);
}
