// What is planned for processes is the same however few layers of bricks are cut at a time.
#include "cut/share_plan.h"

#include "catch.h"
#include "shapes.h"

using namespace mandoline;
using namespace mandoline::detail;
using namespace shapes;

namespace {

constexpr uint64_t kLeast = 1, kAll = ~uint64_t(0);  // of work at a time

/// Cubic grid cells in a box.
Grid gridOf(const std::array<int, 3>& cells, double size) {
  Grid grid;
  for (size_t d = 0; d < 3; ++d) {
    for (int i = 0; i <= cells[d]; ++i) grid.planes[d].push_back(i * size);
  }
  return grid;
}

void requireSameLoads(const Mesh& mesh, const Grid& grid, uint32_t ranks) {
  const PrepareResult prepared = prepare(mesh, {});
  REQUIRE(prepared);
  SharePlanner planner(prepared.mesh, grid, {});
  const std::vector<ShareLoad> few = planner.loads(ranks, {}, kLeast), all = planner.loads(ranks, {}, kAll);
  REQUIRE(few.size() == all.size());
  for (size_t rank = 0; rank < all.size(); ++rank) {
    INFO("process " << rank);
    CHECK(few[rank].work == all[rank].work);
    CHECK(few[rank].cutCells == all[rank].cutCells);
    CHECK(few[rank].faces == all[rank].faces);
    CHECK(few[rank].seamFaces == all[rank].seamFaces);
    CHECK(few[rank].bytesSent == all[rank].bytesSent);  // has the number of regions in it
    CHECK(few[rank].memoryBytes == all[rank].memoryBytes);
  }
}

/// Tubes within each other, of which some end below others, and drops between: regions begin and end in all windows, and are one or two
/// according to what lies in another.
Mesh nested() {
  std::vector<Mesh> all;
  for (int i = 1; i <= 4; ++i) all.push_back(tube({8.03, 7.98, 1.5 * i}, 1.7 * i, 40 - 5.5 * i, 7 + i, i % 2 == 0));
  for (int i = 0; i < 9; ++i) all.push_back(icosphere({1.21, 1.17, 2.3 + 5 * i}, 0.9, 1));
  return merged(all);
}

}  // namespace

TEST_CASE("Plans of tubes within each other tell the same however few layers are cut at a time", "[distributed]") {
  for (const uint32_t ranks : {1u, 7u, 48u, 60u}) requireSameLoads(nested(), gridOf({16, 16, 48}, 1), ranks);
}

TEST_CASE("Plans of triangles in planes between layers tell the same however few are cut at a time", "[distributed]") {
  std::vector<Mesh> boxes;
  for (int i = 0; i < 12; ++i) boxes.push_back(box({2, 2, 4.0 * i}, {10.0 - i % 3, 9, 4.0 * i + 2 + i % 3}));
  boxes.push_back(sheet(30, 4, [](int i, int j) { return Point{11.0 + 0.1 * j, 1.0 + j, 1.6 * i}; }));
  requireSameLoads(merged(boxes), gridOf({13, 11, 50}, 1), 40);
}

TEST_CASE("Plans of triangles that meet tell the same however few layers are cut at a time", "[distributed]") {
  std::vector<Mesh> balls;
  for (int i = 0; i < 8; ++i) balls.push_back(icosphere({6.1 + 0.3 * i, 6.2, 4 + 4.7 * i}, 3.1, 2));
  requireSameLoads(merged(balls), gridOf({14, 13, 44}, 1), 30);
  requireSameLoads(moebius({6, 6, 20}, 18, 5, 40), gridOf({14, 13, 44}, 1), 44);
}
