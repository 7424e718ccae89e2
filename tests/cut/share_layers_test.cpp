// Which layers several processes get, before anything is cut.
#include "cut/share_layers.h"

#include <algorithm>
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

/// The work of the share that has the most.
uint64_t busiest(const ShareLayers& layers, const std::vector<uint64_t>& work, uint32_t shares) {
  uint64_t most = 0;
  for (uint32_t share = 0; share < shares; ++share) {
    REQUIRE(layers.first(share) <= layers.first(share + 1));
    most = std::max(most, std::accumulate(work.begin() + layers.first(share), work.begin() + layers.first(share + 1), uint64_t(0)));
  }
  return most;
}

/// The least that it can have, by all ways to divide the layers.
uint64_t leastBusiest(const std::vector<uint64_t>& work, uint32_t shares) {
  const size_t layers = work.size();
  std::vector<uint64_t> least(layers + 1, ~uint64_t(0));  // of the layers before each, divided among the shares so far
  least[0] = 0;
  for (uint32_t share = 0; share < shares; ++share) {
    for (size_t past = layers; past > 0; --past) {
      uint64_t sum = 0;
      for (size_t first = past; first-- > 0;) {
        sum += work[first];
        least[past] = std::min(least[past], std::max(least[first], sum));
      }
    }
  }
  return least[layers];
}

std::vector<uint64_t> workOf(const Mesh& mesh, const Grid& grid) {
  const PreparedMesh prepared = prepare(mesh).mesh;
  CutStats stats;
  const RunOptions options;
  Monitor monitor(options, 1);
  Run run{stats, monitor};
  return workOfLayers(prepareInput(*prepared.data()->prepared, grid, run));
}

}  // namespace

TEST_CASE("Shares get layers that are alike in work, wherever bricks end", "[stages][bricks]") {
  const ShareLayers two = layersFor(std::vector<uint64_t>(320, 1000), 2);
  CHECK(two.shifts() == BrickGrid::same(5));
  CHECK(two.borders() == std::vector<int32_t>{0, 160, 320});
  const ShareLayers seven = layersFor(std::vector<uint64_t>(320, 1000), 7);
  CHECK(seven.shifts() == BrickGrid::same(5));
  for (uint32_t share = 0; share < 7; ++share) {
    const CellLayers layers = seven.of(share);
    CHECK(layers.past - layers.first >= 45);
    CHECK(layers.past - layers.first <= 46);
  }
}

TEST_CASE("The busiest share has the least that whole layers allow", "[stages][bricks]") {
  uint32_t random = 1;
  for (int round = 0; round < 200; ++round) {
    std::vector<uint64_t> work(1 + size_t(round) % 12);
    for (uint64_t& ofLayer : work) {
      random = random * 1664525 + 1013904223;
      ofLayer = (random >> 16) % 7 * ((random >> 24) % 3);
    }
    for (const uint32_t shares : {1u, 2u, 3u, 5u, 14u}) {
      CAPTURE(round, shares, work);
      const ShareLayers layers = layersFor(work, shares);
      REQUIRE(layers.first(0) == 0);
      REQUIRE(layers.first(shares) == int32_t(work.size()));
      CHECK(busiest(layers, work, shares) == leastBusiest(work, shares));
    }
  }
}

TEST_CASE("Shares of meshes are even within 10 % where no layer is a tenth of a share", "[stages][bricks]") {
  const Mesh meshes[] = {shapes::icosphere({0, 0, 0}, 1, 4), shapes::torus({0, 0, 0}, 2, 0.6, 48, 24),
                         shapes::noisySphere({0, 0, 0}, 1, 0.2, 4),
                         shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::icosphere({0.3, 0, 3}, 0.4, 5)})};
  size_t tried = 0;
  for (const Mesh& mesh : meshes) {
    for (const int cells : {64, 100, 200}) {
      const std::vector<uint64_t> work = workOf(mesh, Grid::around(mesh, cells));
      const uint64_t all = std::accumulate(work.begin(), work.end(), uint64_t(0)), most = *std::max_element(work.begin(), work.end());
      for (const uint32_t shares : {2u, 3u, 4u, 7u, 8u}) {
        if (most * shares > all / 10) continue;
        CAPTURE(mesh.triangleCount(), cells, shares);
        CHECK(busiest(layersFor(work, shares), work, shares) * shares <= all + all / 10);
        ++tried;
      }
    }
  }
  CHECK(tried > 20);
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
  const Mesh blade = {{0.5, 2.5, 3.25, 0.5, 2.5, 3.75, 0.5, 0.25, 3.5}, {0, 1, 2}};
  const Mesh plate = {{0.5, 0.5, 3.5, 4.5, 0.5, 3.5, 0.5, 4.5, 3.5}, {0, 1, 2}}, through = shapes::translated(blade, {0.5, 0, 0});
  const std::vector<uint64_t> apart = workOf(shapes::merged({plate, shapes::translated(blade, {5.5, 0, 0})}), grid);
  CHECK(workOf(shapes::merged({plate, through}), grid)[3] > 2 * apart[3]);  // where triangles meet
  const std::vector<uint64_t> outside = workOf({{0.5, 0.5, 9, 4.5, 0.5, 9, 0.5, 4.5, 9}, {0, 1, 2}}, grid);
  CHECK(outside == std::vector<uint64_t>(8, 0));
}
