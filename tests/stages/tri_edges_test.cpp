#include <cmath>

#include "catch.h"
#include "stages/staged_cut.h"

using namespace stages;

namespace {

/// Slabs of the crossings of the edge between two tri-vertices, from its lower end on.
std::vector<Slab> crossingsOf(const Surface& surface, uint32_t low, uint32_t high) {
  std::vector<Slab> slabs;
  for (size_t e = 0; e < surface.edges.ends.size(); ++e) {
    if (surface.edges.ends[e] != std::array<uint32_t, 2>{low, high}) continue;
    for (uint32_t v = surface.edges.crossingOffsets[e]; v < surface.edges.crossingOffsets[e + 1]; ++v) {
      if (surface.vertices.slabs[v][0] != CutVertices::kUnused) slabs.push_back(surface.vertices.slabs[v]);
    }
  }
  return slabs;
}

}  // namespace

TEST_CASE("Crossings of a tri-edge come in order from its lower end", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({2.5, 0.5, 0.5}, {0.5, 0.75, 0.5}, {0.5, 0.25, 0.75}), Stage::triEdges);
  CHECK(cut.state.surface.edges.ends.size() == 3);
  CHECK(crossingsOf(cut.state.surface, 0, 1) == std::vector<Slab>{{4, 1, 1}, {2, 1, 1}});
  CHECK(crossingsOf(cut.state.surface, 1, 2).empty());
}

TEST_CASE("A crossing of three planes at one point is one vertex", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, {0.5, 0.5, 0.75}), Stage::triEdges);
  CHECK(crossingsOf(cut.state.surface, 0, 1) == std::vector<Slab>{{2, 2, 2}});
}

TEST_CASE("Crossings closer than rounding keep their exact order", "[stages][triEdges]") {
  // The edge passes the grid line x = y = 1 at a distance of one unit in the last place.
  const double off = std::nextafter(0.5, 1);
  const StagedCut cut(shapes::triangle({0.5, off, 0.5}, {1.5, 1.5, 0.5}, {0.5, 0.5, 0.75}), Stage::triEdges);
  CHECK(crossingsOf(cut.state.surface, 0, 1) == std::vector<Slab>{{1, 2, 1}, {2, 3, 1}});
}

TEST_CASE("Triangles share an edge, and duplicates are dropped", "[stages][triEdges]") {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 1, 0, 3, 2, 0, 1, 0, 2, 1}};
  const StagedCut cut(mesh, Stage::triEdges);
  CHECK(cut.state.surface.edges.ends.size() == 5);
  CHECK(cut.stats.duplicateTriangles == 2);
  CHECK(cut.state.surface.input.kept(0));
  CHECK(cut.state.surface.input.states[2] == TriangleState::duplicate);
  CHECK(cut.state.surface.input.states[3] == TriangleState::duplicate);
}

TEST_CASE("Edges in a grid-face are cut at its sides", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({0.5, 0.5, 1}, {1.5, 0.5, 1}, {0.75, 0.5, 1.5}), Stage::triEdges);
  const std::vector<FaceEdge>& inPlane = cut.state.surface.edges.inPlane;
  REQUIRE(inPlane.size() == 2);
  CHECK(inPlane[0].element == Slab{1, 1, 2});
  CHECK(inPlane[1].element == Slab{3, 1, 2});
  CHECK(inPlane[0].to == inPlane[1].from);
}
