// Which layers several processes get, before anything is cut.
#include "cut/share_layers.h"

#include <numeric>

#include "catch.h"
#include "cut/driver.h"
#include "cut/stages/input.h"
#include "mandoline/prepare.h"
#include "shapes.h"

using namespace mandoline;
using namespace mandoline::detail;

namespace {

/// Of a grid of so many cells along each axis.
Input inputOf(int64_t cells) {
  Input input;
  input.planes.fill(std::vector<double>(size_t(cells) + 1));
  return input;
}

ShareLayers layersFor(const std::vector<uint64_t>& work, uint32_t shares) { return {inputOf(int64_t(work.size())), work, shares}; }

std::vector<uint64_t> workOf(const Mesh& mesh, const Grid& grid) {
  const PreparedMesh prepared = prepare(mesh).mesh;
  CutStats stats;
  const RunOptions options;
  Monitor monitor(options, 1);
  Run run{stats, monitor};
  return workOfLayers(prepareInput(*prepared.data()->prepared, grid, run));
}

}  // namespace

TEST_CASE("Shares get layers that are alike in work, of thinner bricks where these are needed for it", "[stages][bricks]") {
  const ShareLayers two = layersFor(std::vector<uint64_t>(320, 1000), 2);
  CHECK(two.shifts() == BrickGrid::same(5));
  CHECK(two.first(1) == 160);
  CHECK(two.first(2) == 320);
  const ShareLayers seven = layersFor(std::vector<uint64_t>(320, 1000), 7);
  CHECK(seven.shifts()[2] < 5);
  for (uint32_t share = 0; share < 7; ++share) CHECK(seven.of(share).past - seven.of(share).first <= 1.1 * 320 / 7);
}

TEST_CASE("Of work in one layer one share has all, and more shares than layers are left without", "[stages][bricks]") {
  std::vector<uint64_t> work(64, 0);
  work[40] = 1000000;
  const ShareLayers layers = layersFor(work, 4);
  uint32_t busy = 0;
  for (uint32_t share = 0; share < 4; ++share) busy += layers.of(share).first <= 40 && layers.of(share).past > 40;
  CHECK(busy == 1);
  const ShareLayers many = layersFor(std::vector<uint64_t>(3, 1000), 100000);
  uint32_t with = 0;
  for (uint32_t share = 0; share < 100000; ++share) {
    REQUIRE(many.of(share).first <= many.of(share).past);
    with += many.of(share).first < many.of(share).past;
  }
  CHECK(with == 3);
  CHECK(many.first(100000) == 3);
}

TEST_CASE("Work goes to the layers that triangles touch, and grows with them", "[stages][bricks]") {
  const Grid grid = Grid::box({0, 0, 0}, {8, 8, 8}, {8, 8, 8});
  const std::vector<uint64_t> flat = workOf({{0.5, 0.5, 3.5, 4.5, 0.5, 3.5, 0.5, 4.5, 3.5}, {0, 1, 2}}, grid);
  CHECK(std::accumulate(flat.begin(), flat.end(), uint64_t(0)) == flat[3]);
  const std::vector<uint64_t> larger = workOf({{0.5, 0.5, 3.5, 7.5, 0.5, 3.5, 0.5, 7.5, 3.5}, {0, 1, 2}}, grid);
  CHECK(larger[3] > 2 * flat[3]);
  const std::vector<uint64_t> upright = workOf({{0.5, 0.5, 1.5, 4.5, 0.5, 1.5, 0.5, 0.5, 5.5}, {0, 1, 2}}, grid);
  CHECK(upright == std::vector<uint64_t>{0, upright[1], upright[1], upright[1], upright[1], upright[1], 0, 0});
  CHECK(upright[1] > 0);
  const std::vector<uint64_t> outside = workOf({{0.5, 0.5, 9, 4.5, 0.5, 9, 0.5, 4.5, 9}, {0, 1, 2}}, grid);
  CHECK(outside == std::vector<uint64_t>(8, 0));
}
