#include <algorithm>

#include "catch.h"
#include "staged_cut.h"

using namespace stages;

namespace {

std::vector<int32_t> sorted(std::vector<int32_t> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

TEST_CASE("A closed surface has an inside with winding number 1", "[stages][regions]") {
  const Mesh box = shapes::cube(0.5, 2.5);
  const Regions regions = StagedCut(box, Stage::regions).state.regions;
  CHECK(regions.count == 2);
  REQUIRE(regions.hasWinding);
  CHECK(sorted(regions.winding) == std::vector<int32_t>{0, 1});
  CHECK(sorted(StagedCut(shapes::flipped(box), Stage::regions).state.regions.winding) == std::vector<int32_t>{-1, 0});
}

TEST_CASE("The winding number is anchored where the surface leaves the grid", "[stages][regions]") {
  const Regions regions = StagedCut(shapes::cube(-1, 1.5), Stage::regions).state.regions;
  CHECK(regions.winding == std::vector<int32_t>{1, 0});  // the lowest corner lies inside
}

TEST_CASE("Nested surfaces count up", "[stages][regions]") {
  const Mesh mesh = shapes::merged({shapes::cube(0.25, 2.75), shapes::cube(0.5, 2.5), shapes::flipped(shapes::cube(1.25, 1.75))});
  CHECK(sorted(StagedCut(mesh, Stage::regions).state.regions.winding) == std::vector<int32_t>{0, 1, 1, 2});
}

TEST_CASE("Open and inconsistently oriented surfaces have no winding numbers", "[stages][regions]") {
  Mesh box = shapes::cube(0.5, 2.5);
  Mesh open = box;
  open.triangles.resize(open.triangles.size() - 3);
  CHECK_FALSE(StagedCut(open, Stage::regions).state.regions.hasWinding);
  CHECK(StagedCut(open, Stage::regions).state.regions.count == 1);
  std::swap(box.triangles[0], box.triangles[1]);
  CHECK_FALSE(StagedCut(box, Stage::regions).state.regions.hasWinding);
  CHECK(StagedCut(box, Stage::regions).state.regions.count == 2);
}

TEST_CASE("Untouched grid cells are runs along x", "[stages][regions]") {
  const UntouchedRuns runs = StagedCut(shapes::octahedron({1.5, 1.5, 1.5}, 0.25), Stage::regions).state.runs;
  CHECK(runs.rowOffsets == std::vector<uint32_t>{0, 1, 2, 3, 4, 6, 7, 8, 9, 10});
  CHECK(runs.begin[4] == 0);
  CHECK(runs.end[4] == 1);
  CHECK(runs.begin[5] == 2);
  CHECK(runs.end[5] == 3);
}

TEST_CASE("A sheet divides the grid into regions only where it reaches the border", "[stages][regions]") {
  const auto sheet = [](double reach) {
    return shapes::quad({-reach, -reach, 1.5}, {3 + reach, -reach, 1.5}, {3 + reach, 3 + reach, 1.5}, {-reach, 3 + reach, 1.5});
  };
  CHECK(StagedCut(sheet(1), Stage::regions).state.regions.count == 2);
  CHECK(StagedCut(sheet(-0.5), Stage::regions).state.regions.count == 1);
}
