#include <algorithm>

#include "catch.h"
#include "staged_cut.h"

using namespace stages;

namespace {

/// A triangle across the grid line x = y = 1 that meets it at height z.
Mesh across(double z) { return shapes::triangle({0.75, 0.75, z}, {1.25, 0.75, z}, {1, 1.5, z}); }

}  // namespace

TEST_CASE("Vertices on a grid-edge come in order along it", "[stages][gridEdges]") {
  const StagedCut cut(shapes::merged({across(0.75), across(0.25), across(0.5)}), Stage::gridEdges);
  const CutVertices& vertices = cut.brick.vertices;
  size_t cutEdges = 0;
  for (const GridEdgeId e : Ids<GridEdgeId>(cut.gridEdges.vertices.size())) {
    const auto on = cut.gridEdges.vertices[e];
    if (on.empty()) continue;
    ++cutEdges;
    REQUIRE(on.size() == 3);
    CHECK(vertices.triangle(on[0]) == TriangleId{1});
    CHECK(vertices.triangle(on[1]) == TriangleId{2});
    CHECK(vertices.triangle(on[2]) == TriangleId{0});
  }
  CHECK(cutEdges == 1);
}

TEST_CASE("A surface vertex at a grid vertex is that grid vertex", "[stages][gridEdges]") {
  const StagedCut cut(shapes::triangle({1, 1, 1}, {1.5, 1.25, 1.5}, {1.25, 1.5, 1.5}), Stage::gridEdges);
  const auto& corners = cut.gridEdges.corners;
  CHECK(std::count(corners.begin(), corners.end(), VertexId{0}) == 1);
  for (const VertexId v : cut.brick.vertices.ownIds()) CHECK(std::count(corners.begin(), corners.end(), v) == 1);
  CHECK(cut.brick.vertices.slabs.size() == 7);
}

TEST_CASE("Two unresolved triangles through one point of a grid line are a self-intersection", "[stages][gridEdges]") {
  const Mesh tilted = shapes::triangle({0.75, 0.75, 0.5}, {1.25, 0.75, 0.25}, {1, 1.25, 0.625});  // the plane through (1, 1, 0.5)
  try {
    StagedCut(shapes::merged({across(0.5), tilted}), Stage::gridEdges, unresolved());
    FAIL("no failure");
  } catch (const Failure& failure) {
    CHECK(failure.error.status == Status::selfIntersection);
  }
}
