#include "mandoline/cut_share.h"

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
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
  const CutResult result = cutInShares(prepared, grid, count, options);
  CAPTURE(result.error.message);
  REQUIRE(result);
  CHECK(differences(result.mesh, whole.mesh) == std::vector<std::string>());
  CHECK(result.stats.madeVertices == whole.stats.madeVertices);
  CHECK(result.stats.outsideTriangles == whole.stats.outsideTriangles);
  CHECK(result.stats.stages.size() == whole.stats.stages.size());
}

}  // namespace

TEST_CASE("Shares give the whole cut, to the bit, for any number of them", "[shares][seams]") {
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name, one.mesh.triangleCount());
    for (const uint32_t count : {1u, 2u, 3u, 7u}) checkShares(one.mesh, one.grid, count, 1 + count % 3);
  }
}

TEST_CASE("Shares are the same where seams pass through what is hard", "[shares][seams]") {
  std::vector<Mesh> meshes = seamMeshes();
  meshes.push_back(shapes::cube(20, 30));  // outside of the grid
  for (const Mesh& mesh : meshes) {
    CAPTURE(mesh.triangleCount());
    for (const uint32_t count : {2u, 3u, 4u, 7u, 20u}) checkShares(mesh, seamGrid(), count);
  }
}
