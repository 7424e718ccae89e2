#include "mandoline/cut_share.h"

#include <cmath>
#include <limits>

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
#include "cut/share_excerpt.h"
#include "refusal.h"
#include "same_bits.h"
#include "seam_meshes.h"
#include "shared_cut.h"

using namespace mandoline;

namespace {

void checkShares(const Mesh& mesh, const Grid& grid, uint32_t count, unsigned threads = 1) {
  CAPTURE(count, threads);
  const PreparedMesh prepared = prepare(mesh).mesh;
  const CutResult whole = cut(prepared, grid);
  REQUIRE(whole);
  RunOptions options;
  options.threads = threads;
  for (detail::TakeExcerpt* takeExcerpt : {static_cast<detail::TakeExcerpt*>(nullptr), detail::takeExcerpt}) {
    CAPTURE(takeExcerpt != nullptr);
    const CutResult result = cutInShares(prepared, grid, count, options, takeExcerpt);
    CAPTURE(result.error.message);
    REQUIRE(result);
    CHECK(differences(result.mesh, whole.mesh) == std::vector<std::string>());
    CHECK(result.stats.madeVertices == whole.stats.madeVertices);
    CHECK(result.stats.outsideTriangles == whole.stats.outsideTriangles);
    CHECK(result.stats.stages.size() == whole.stats.stages.size());
  }
}

size_t trianglesOfExcerpts = 0;

std::unique_ptr<detail::ShareExcerpt> countedExcerpt(const MeshView& mesh, detail::CutState& state) {
  auto excerpt = detail::takeExcerpt(mesh, state);
  trianglesOfExcerpts += excerpt->excerpt.triangles.size();
  return excerpt;
}

}  // namespace

TEST_CASE("Shares give the whole cut, to the bit, for any number of them", "[shares][seams]") {
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name, one.mesh.triangleCount());
    for (const uint32_t count : {1u, 2u, 3u, 7u}) checkShares(one.mesh, one.grid, count, 1 + count % 3);
  }
}

TEST_CASE("Shares give the whole cut where coordinates are subnormal, so that rounding would put vertices onto planes", "[shares]") {
  const double least = std::numeric_limits<double>::denorm_min();
  for (NamedCase one : casesAndSoups()) {
    CAPTURE(one.name, one.mesh.triangleCount());
    for (double& x : one.mesh.positions) x = std::round(8 * x) * least;
    for (auto& planes : one.grid.planes) {
      for (double& x : planes) x = std::round(8 * x) * least;
    }
    if (!cut(one.mesh, Grid::rectilinear(one.grid.planes))) continue;  // planes that are one now
    for (const uint32_t count : {3u, 5u}) checkShares(one.mesh, Grid::rectilinear(one.grid.planes), count);
  }
}

TEST_CASE("An excerpt has the triangles in the layers of its share alone", "[shares]") {
  const Mesh mesh = shapes::icosphere({0, 0, 0}, 1, 4);
  const PreparedMesh prepared = prepare(mesh).mesh;
  trianglesOfExcerpts = 0;
  REQUIRE(cutInShares(prepared, Grid::around(mesh, 32), 4, {1, {}}, countedExcerpt));
  CHECK(trianglesOfExcerpts > mesh.triangleCount());  // those on planes between layers come twice
  CHECK(trianglesOfExcerpts < mesh.triangleCount() * 5 / 4);
}

TEST_CASE("A contradiction that a share finds in an excerpt names triangles of the whole mesh", "[shares]") {
  const Mesh below = shapes::icosphere({4, 4, 1}, 0.9, 3);
  const Mesh mesh = shapes::merged({below, shapes::cube(5.25, 6.5), shapes::box({5.75, 5.25, 5.25}, {7, 6.5, 6.5})});
  const PreparedMesh prepared = prepare(mesh, {{1, {}}, Intersections::assumeNone}).mesh;
  size_t named = 0;
  for (uint32_t share = 0; share < 4; ++share) {
    try {
      const CutShare cut(prepared, unitGrid(8), {share, 4}, {1, {}}, detail::takeExcerpt);
    } catch (const CallError& failure) {
      ++named;
      CHECK(failure.error.status == Status::selfIntersection);
      CHECK(failure.error.element >= int64_t(below.triangleCount()));
      CHECK(failure.error.message == "Triangles meet other than in shared vertices and edges, at triangle " +
                                         std::to_string(failure.error.element) + " or near it; a cut in one process names two.");
    }
  }
  CHECK(named > 0);
}

TEST_CASE("Shares are the same where seams pass through what is hard", "[shares][seams]") {
  std::vector<Mesh> meshes = seamMeshes();
  meshes.push_back(shapes::cube(20, 30));  // outside of the grid
  for (const Mesh& mesh : meshes) {
    CAPTURE(mesh.triangleCount());
    for (const uint32_t count : {2u, 3u, 4u, 7u, 20u}) checkShares(mesh, seamGrid(), count);
  }
}

TEST_CASE("Shares are the same where their border lies inside what would be a brick", "[shares][seams]") {
  const Grid grid = unitGrid(12, 12, 40);
  const auto around = [](double z) {  // what is hard in a plane across z, or through it
    return shapes::merged({shapes::box({1.5, 1.5, 2.5}, {10.5, 10.5, z}), shapes::octahedron({6, 6, z}, 1.5),
                           shapes::torus({6.1, 5.9, z + 0.1}, 3, 0.8, 12, 8),
                           shapes::quad({0.5, 3, z}, {5, 3, z}, {5, 11.5, z}, {0.5, 11.5, z}),
                           shapes::box({2.5, 2.5, z}, {9.5, 9.5, 38.5})});
  };
  for (const double z : {19.0, 20.0, 21.0, 20.5}) {
    CAPTURE(z);
    const Mesh mesh = around(z);
    const PreparedMesh prepared = prepare(mesh).mesh;
    size_t inside = 0;
    for (const uint32_t count : {2u, 3u, 4u, 7u}) {
      for (uint32_t share = 1; share < count; ++share) inside += CutShare(prepared, grid, {share, count}).layers()[0] % 8 != 0;
      checkShares(mesh, grid, count);
    }
    CHECK(inside > 0);
  }
}

TEST_CASE("What shares tell each other takes few bytes for each of their cut-cells", "[shares]") {
  const Mesh mesh = shapes::icosphere({0, 0, 0}, 1, 5);
  const PreparedMesh prepared = prepare(mesh).mesh;
  const Grid grid = Grid::around(mesh, 100);
  size_t words = 0;
  for (uint32_t share = 0; share < 2; ++share) words += CutShare(prepared, grid, {share, 2}).summary().size();
  CHECK(words * sizeof(uint32_t) < 20 * cut(prepared, grid).mesh.cellCount());
}

TEST_CASE("The first share, which waits for what others send, has a little more to cut than they have", "[shares]") {
  const Mesh mesh = shapes::icosphere({0, 0, 0}, 1, 5);
  const Grid grid = Grid::around(mesh, 100);
  const auto [first, past] = CutShare(prepare(mesh).mesh, grid, {0, 2}).layers();
  CHECK(first == 0);
  CHECK(2 * past > grid.cells(2));
  CHECK(20 * past < 11 * grid.cells(2));
}

TEST_CASE("A share knows the regions of all untouched grid cells once its part is made, before there are those of others", "[shares]") {
  const Mesh mesh = shapes::icosphere({0, 0, 0}, 1, 2);
  const PreparedMesh prepared = prepare(mesh).mesh;
  const Grid grid = Grid::around(mesh, 12);
  std::vector<CutShare> shares{{prepared, grid, {0, 2}}, {prepared, grid, {1, 2}}};
  const std::array summaries{shares[0].summary(), shares[1].summary()};
  CHECK(refusal([&] { shares[0].gridCellRegion(); }).first == Status::badArgument);
  std::vector<CutPart> parts;
  for (CutShare& share : shares) {
    parts.push_back(share.part(summaries));
    CHECK(share.gridCellRegion() == cut(prepared, grid).mesh.gridCellRegion());
  }
  REQUIRE(shares[0].join(std::move(parts)));
  CHECK(refusal([&] { shares[0].gridCellRegion(); }).first == Status::badArgument);
}

TEST_CASE("Shares that keep the mesh and shares that don't meet elsewhere, so their summaries don't go together", "[shares]") {
  const Mesh mesh = shapes::icosphere({0, 0, 0}, 1, 4);
  const PreparedMesh prepared = prepare(mesh).mesh;
  const Grid grid = Grid::around(mesh, 100);
  CutShare keeping(prepared, grid, {0, 2});
  const CutShare other(prepared, grid, {1, 2}, {}, detail::takeExcerpt);
  REQUIRE(keeping.layers()[1] != other.layers()[0]);
  const std::array summaries{keeping.summary(), other.summary()};
  CHECK(refusal([&] { keeping.part(summaries); }) == std::pair{Status::badArgument, int64_t(1)});
}

TEST_CASE("A summary of another share that ends too early, or goes on, is refused", "[shares]") {
  const Mesh mesh = shapes::icosphere({0, 0, 0}, 1, 1);
  const PreparedMesh prepared = prepare(mesh).mesh;
  const Grid grid = Grid::around(mesh, 4);
  const std::vector<uint32_t> first = CutShare(prepared, grid, {0, 2}).summary(), second = CutShare(prepared, grid, {1, 2}).summary();
  for (size_t length = 0; length < first.size() + 2; ++length) {
    CAPTURE(length, first.size());
    std::vector<uint32_t> told = first;
    told.resize(length);
    CutShare share(prepared, grid, {1, 2});
    Status status = Status::ok;
    try {
      share.part(std::array{told, second});
    } catch (const CallError& failure) {
      status = failure.error.status;
      CHECK(failure.error.element == 0);
    }
    CHECK(status == (length == first.size() ? Status::ok : Status::badArgument));
  }
}
