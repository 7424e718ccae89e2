#include "case_list.h"
#include "catch.h"
#include "same_bits.h"
#include "staged_cut.h"

using namespace stages;

TEST_CASE("The surface's grid cells are touched, each in one brick", "[stages][bricks]") {
  Way way;
  way.brickShift = 1;  // of 2 cells along each side, and 1 at the end
  const StagedCut cut(shapes::triangle({1.25, 1.25, 1.25}, {2.75, 1.25, 1.5}, {1.25, 1.75, 1.5}), Stage::regions, way);
  const Bricks& bricks = cut.state.bricks;
  REQUIRE(bricks.size() == 2);
  CHECK(bricks.boxes[{1}].first == std::array<int32_t, 3>{2, 0, 0});
  CHECK(bricks.boxes[{1}].count == std::array<int32_t, 3>{1, 2, 2});
  CHECK(bricks.isTouched({3, 3, 3}));
  CHECK(bricks.isTouched({5, 3, 3}));
  CHECK_FALSE(bricks.isTouched({1, 3, 3}));
  CHECK_FALSE(bricks.isTouched({5, 5, 5}));
}

TEST_CASE("The result is the same to the bit for all sizes of bricks", "[stages][bricks][seams]") {
  size_t cells = 0;
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name, one.mesh.triangleCount());
    const CutMesh whole = cutMeshOf(one.mesh, one.grid);
    for (const int shift : {0, 1, 2, 3, 4}) {  // 0: every grid cell is a brick, and every grid-face lies on a seam
      CAPTURE(shift);
      Way way;
      way.brickShift = shift;
      way.options.threads = 1 + unsigned(shift) % 3;
      CHECK(differences(cutMeshOf(one.mesh, one.grid, way), whole).empty());
    }
    cells += whole.cellCount();
  }
  CHECK(cells > 5000);
}

TEST_CASE("The result is the same to the bit wherever bricks begin anew", "[stages][bricks][seams]") {
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name, one.mesh.triangleCount());
    const CutMesh whole = cutMeshOf(one.mesh, one.grid);
    for (const std::vector<int32_t>& anew : {std::vector<int32_t>{1}, {2, 3}, {0, 3, 3, 5}}) {
      Way way;
      way.brickShift = 2;
      way.bricksAnew = anew;
      CHECK(differences(cutMeshOf(one.mesh, one.grid, way), whole).empty());
    }
  }
}

TEST_CASE("The result is the same to the bit without short cuts", "[stages][bricks]") {
  Way onlyGeneral;
  onlyGeneral.onlyGeneral = true;
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name, one.mesh.triangleCount());
    CHECK(differences(cutMeshOf(one.mesh, one.grid, onlyGeneral), cutMeshOf(one.mesh, one.grid)).empty());
  }
}

namespace {

/// Of a grid of so many cells along each axis.
Input inputOf(int64_t cells) {
  Input input;
  input.planes.fill(std::vector<double>(size_t(cells) + 1));
  return input;
}

}  // namespace

TEST_CASE("Several threads write each brick once, and none beside those that others write at the same time", "[stages][bricks]") {
  const auto numbers = [](uint32_t first, uint32_t past, unsigned threads) { return BricksHere{{first}, {past}}.numbers(threads); };
  using List = std::vector<uint32_t>;
  CHECK(numbers(2, 6, 1) == List{2, 3, 4, 5});
  CHECK(numbers(2, 7, 2) == List{2, 5, 3, 6, 4});
  CHECK(numbers(0, 7, 3) == List{0, 3, 6, 1, 4, 2, 5});
  CHECK(numbers(1, 3, 8) == List{1, 2});
  CHECK(numbers(4, 4, 2).empty());
}

TEST_CASE("Where bricks begin anew, none reaches beyond, and planes there are between bricks", "[stages][bricks]") {
  const std::vector<int32_t> anew = {0, 6, 6, 12, 17};
  const BrickGrid grid(inputOf(17), BrickGrid::same(2), anew);
  CHECK(grid.counts == std::array<int32_t, 3>{5, 5, 6});
  std::vector<std::array<int32_t, 2>> layers;
  for (int32_t at = 0; at < 6; ++at) {
    const BrickBox box = grid.boxOf(uint64_t(at) * 25);
    layers.push_back({box.first[2], box.count[2]});
    for (int32_t z = 0; z < box.count[2]; ++z) CHECK(grid.keyOf({1, 1, 2 * (box.first[2] + z) + 1}) == uint64_t(at) * 25);
  }
  CHECK(layers == std::vector<std::array<int32_t, 2>>{{0, 4}, {4, 2}, {6, 4}, {10, 2}, {12, 4}, {16, 1}});
  std::vector<int32_t> between, onSeams;
  for (int32_t slab = -2; slab <= 2 * 17 + 2; ++slab) {
    if (grid.isBetween(2, slab)) between.push_back(slab / 2);
    if (grid.isOnSeam({1, 1, slab})) onSeams.push_back(slab / 2);
  }
  CHECK(between == std::vector<int32_t>{0, 4, 6, 10, 12, 16, 17});
  CHECK(onSeams == std::vector<int32_t>{4, 6, 10, 12, 16});
  CHECK(grid.planeFrom(2, 5) == 6);
  CHECK(grid.planeFrom(2, 6) == 6);
  CHECK(grid.planeFrom(2, 17) == 17);
  CHECK(grid.isInsideOne({1, 1, 13}, {7, 7, 19}));
  CHECK_FALSE(grid.isInsideOne({1, 1, 11}, {7, 7, 13}));  // through the plane between two
  CHECK_FALSE(grid.isInsideOne({1, 1, 12}, {7, 7, 19}));  // to that plane
  CHECK_FALSE(grid.isInsideOne({1, 1, -1}, {7, 7, -1}));  // below the grid
  CHECK_FALSE(grid.isInsideOne({1, 1, 35}, {7, 7, 35}));  // above it
}

TEST_CASE("Bricks of a small grid are smaller where there are several threads", "[stages][bricks]") {
  const auto shiftFor = [](int64_t cells, unsigned threads) { return BrickGrid::shiftsFor(inputOf(cells), threads); };
  CHECK(shiftFor(10, 1) == BrickGrid::same(5));
  CHECK(shiftFor(10, 2) == BrickGrid::same(3));
  CHECK(shiftFor(50, 2) == std::array{5, 5, 4});
  CHECK(shiftFor(50, 16) == std::array{4, 3, 3});
  CHECK(shiftFor(200, 2) == BrickGrid::same(5));
}
