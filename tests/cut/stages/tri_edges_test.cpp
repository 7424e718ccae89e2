#include <cmath>

#include "catch.h"
#include "staged_cut.h"

using namespace stages;

namespace {

/// Slabs of the crossings of the edge between two tri-vertices, from its lower end on.
std::vector<Slab> crossingsOf(const Surface& surface, VertexId low, VertexId high) {
  std::vector<Slab> slabs;
  for (const TriEdgeId e : surface.edges().ends.ids()) {
    if (surface.edges().ends[e] != std::array<VertexId, 2>{low, high}) continue;
    for (const VertexId v : surface.vertices.crossings(e)) {
      if (surface.vertices.isUsed(v)) slabs.push_back(surface.vertices.slab(v));
    }
  }
  return slabs;
}

}  // namespace

TEST_CASE("Crossings of a tri-edge come in order from its lower end", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({2.5, 0.5, 0.5}, {0.5, 0.75, 0.5}, {0.5, 0.25, 0.75}), Stage::triEdges);
  CHECK(cut.state.surface.edges().ends.size() == 3);
  CHECK(crossingsOf(cut.state.surface, {0}, {1}) == std::vector<Slab>{{4, 1, 1}, {2, 1, 1}});
  CHECK(crossingsOf(cut.state.surface, {1}, {2}).empty());
}

TEST_CASE("A crossing of three planes at one point is one vertex", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, {0.5, 0.5, 0.75}), Stage::triEdges);
  CHECK(crossingsOf(cut.state.surface, {0}, {1}) == std::vector<Slab>{{2, 2, 2}});
}

TEST_CASE("Crossings closer than rounding keep their exact order", "[stages][triEdges]") {
  // The edge passes the grid line x = y = 1 at a distance of one unit in the last place.
  const double off = std::nextafter(0.5, 1);
  const StagedCut cut(shapes::triangle({0.5, off, 0.5}, {1.5, 1.5, 0.5}, {0.5, 0.5, 0.75}), Stage::triEdges);
  CHECK(crossingsOf(cut.state.surface, {0}, {1}) == std::vector<Slab>{{1, 2, 1}, {2, 3, 1}});
}

TEST_CASE("Triangles share an edge, and duplicates are dropped", "[stages][triEdges]") {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 1, 0, 3, 2, 0, 1, 0, 2, 1}};
  const StagedCut cut(mesh, Stage::triEdges);
  CHECK(cut.state.surface.edges().ends.size() == 5);
  CHECK(cut.prepared->duplicates.size() == 2);
  CHECK(cut.prepared->kept(size_t(0)));
  CHECK(cut.prepared->states[2] == TriangleState::duplicate);
  CHECK(cut.prepared->states[3] == TriangleState::duplicate);
}

TEST_CASE("Edges in a grid-face are cut at its sides", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({0.5, 0.5, 1}, {1.5, 0.5, 1}, {0.75, 0.5, 1.5}), Stage::triEdges);
  const std::vector<FaceEdge>& inPlane = cut.state.surface.edgesInPlane;
  REQUIRE(inPlane.size() == 2);
  CHECK(inPlane[0].element == Slab{1, 1, 2});
  CHECK(inPlane[1].element == Slab{3, 1, 2});
  CHECK(inPlane[0].to == inPlane[1].from);
}
