#include <cmath>

#include "catch.h"
#include "grid/snap.h"
#include "staged_cut.h"

using namespace stages;

TEST_CASE("Scaled coordinates are the input's times one power of two", "[stages][input]") {
  const Mesh mesh = shapes::triangle({0.1, 0.7, 2.3}, {1.9, 0.3, 1e-9}, {0.2, 2.9, 1.1});
  const StagedCut cut(mesh, Stage::input);
  for (size_t i = 0; i < 9; ++i) CHECK(Scale(cut.prepared->shift).world(cut.prepared->points[i / 3][i % 3]) == mesh.positions[i]);
  CHECK(cut.prepared->counts.flushedCoordinates == 0);
  CHECK(std::fabs(std::ilogb(cut.state.surface.input.planes[0].back())) <= 121);
}

TEST_CASE("Coordinates below 2^-200 of the largest count as 0", "[stages][input]") {
  const StagedCut cut(shapes::triangle({0, 1e-70, 0}, {1, 0, 0}, {0, 1, 0}), Stage::input);
  CHECK(cut.prepared->counts.flushedCoordinates == 1);
  CHECK(cut.prepared->points[0][1] == 0);
}

TEST_CASE("Slabs name the planes that vertices lie on, and where they lie between them", "[stages][input]") {
  const StagedCut cut(shapes::triangle({1, 1.5, 3}, {-0.5, 0, 3.5}, {2.5, 2, 0.25}), Stage::input);
  const Input& input = cut.state.surface.input;
  CHECK(input.slabs[{0}] == Slab{2, 3, 6});
  CHECK(input.slabs[{1}] == Slab{-1, 0, 7});
  CHECK(input.slabs[{2}] == Slab{5, 4, 1});
}

TEST_CASE("Snapping moves coordinates onto planes within the tolerance", "[stages][input]") {
  const Mesh mesh = shapes::triangle({1.05, 1.2, 2.96}, {0.5, 0.5, 0.5}, {2.5, 0.5, 0.5});
  const SnappedMesh moved = snapped(mesh, unitCells(), 0.1);
  CHECK(moved.mesh.positions == std::vector<double>{1, 1.2, 3, 0.5, 0.5, 0.5, 2.5, 0.5, 0.5});
  CHECK(moved.mesh.triangles == mesh.triangles);
  CHECK(moved.vertices == 1);
  CHECK(moved.largest == Approx(0.05));
}

TEST_CASE("Vertices at one position are welded, 0 and -0 alike", "[stages][input]") {
  Mesh mesh = shapes::merged({shapes::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), shapes::triangle({-0.0, 0, 0}, {0, 1, 0}, {0, 0, 1})});
  const StagedCut cut(mesh, Stage::input);
  CHECK(cut.prepared->counts.weldedVertices == 2);
  CHECK(cut.prepared->triangles[1] == std::array<uint32_t, 3>{0, 2, 5});
}

TEST_CASE("A triangle without area is dropped, and its vertex stays on its neighbour's edge", "[stages][input]") {
  // Vertex 3 is the middle of the edge 0 1: triangle (0, 1, 3) has no area.
  const Mesh mesh{{0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 0, 0}, {0, 1, 2, 0, 3, 1}};
  const StagedCut cut(mesh, Stage::input);
  const Prepared& input = *cut.prepared;
  CHECK(input.kept(size_t(0)));
  CHECK(input.states[1] == TriangleState::zeroArea);
  REQUIRE(input.stitches.size() == 1);
  CHECK(input.stitches[0].low == 0);
  CHECK(input.stitches[0].high == 1);
  CHECK(input.stitches[0].vertices == std::vector<uint32_t>{3});
}
