// All cells as one mesh: that it is conforming follows from sums of its directed edges and of its areas.
#include "mandoline/cell_complex.h"

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
#include "conforming_cells.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

CoarsenOptions levels(int maxLevel, bool balanceEdges = false) {
  CoarsenOptions options;
  options.maxLevel = maxLevel, options.balanceEdges = balanceEdges;
  return options;
}

void requireTags(const CellComplex& cells, const CutMesh& cutMesh) {
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    const int32_t front = cells.faceCells[2 * f], back = cells.faceCells[2 * f + 1];
    const FaceTag tag = cells.faceTag[f];
    CAPTURE(f, front, back, int(tag));
    REQUIRE((tag == FaceTag::surface) == (f < cutMesh.faceCount() && cutMesh.faceTriangle[f] >= 0));
    if (tag == FaceTag::surface) continue;
    REQUIRE((tag == FaceTag::inner) == (front >= 0 && back >= 0));
    REQUIRE((front >= 0 || back >= 0));
    if (tag == FaceTag::inner) {
      REQUIRE(cells.cellRegion[size_t(front)] == cells.cellRegion[size_t(back)]);
      continue;
    }
    const size_t axis = size_t(tag) / 2;
    const auto& planes = cutMesh.grid.planes[axis];
    REQUIRE(cells.faceCentroid[3 * f + axis] == (size_t(tag) % 2 ? planes.back() : planes.front()));
    REQUIRE((size_t(tag) % 2 ? back : front) == -1);
  }
}

CellComplex checkedComplex(const Mesh& mesh, const Grid& grid, const CoarsenOptions& options) {
  const CutResult result = cut(mesh, grid);
  REQUIRE(result);
  const CellComplex cells = ::checkedComplex(mesh, result.mesh, options);
  requireTags(cells, result.mesh);
  return cells;
}

}  // namespace

TEST_CASE("cell complex: conforming on all cases, single grid cells and octree cells", "[cellcomplex]") {
  for (const NamedCase& c : caseList()) {
    CAPTURE(c.name);
    checkedComplex(c.mesh, c.grid, levels(0));
    checkedComplex(c.mesh, c.grid, levels(24));
    checkedComplex(c.mesh, c.grid, levels(24, true));
  }
}

TEST_CASE("cell complex: a ball in grids of any counts", "[cellcomplex]") {
  const Mesh ball = shapes::icosphere({9, 5, 4}, 2.2, 2);
  for (const auto& grid : {unitGrid(33, 10, 7), unitGrid(16, 16, 16), unitGrid(17, 9, 32)}) {
    const CellComplex single = checkedComplex(ball, grid, levels(0)), octree = checkedComplex(ball, grid, levels(24));
    CHECK(octree.cellCount() < single.cellCount() / 2);
    CHECK(single.cutCells == octree.cutCells);
  }
}

TEST_CASE("cell complex: the faces of single grid cells", "[cellcomplex]") {
  const Mesh far = shapes::cube(100, 101);  // nothing is cut
  const CellComplex cells = checkedComplex(far, unitGrid(4, 3, 2), levels(0));
  CHECK(cells.cellCount() == 24);
  CHECK(cells.faceCount() == 5 * 3 * 2 + 4 * 4 * 2 + 4 * 3 * 3);
  CHECK(cells.vertexCount() == 5 * 4 * 3);
  CHECK(checkedComplex(far, unitGrid(4, 3, 2), levels(24)).faceCount() == 6);
}

TEST_CASE("cell complex: a large cell beside smaller ones has their faces and vertices", "[cellcomplex]") {
  // One cut grid cell in a corner of 8^3: sizes 1, 2 and 4 meet.
  const CellComplex cells = checkedComplex(shapes::cube(0.25, 0.75), unitGrid(8), levels(24));
  CHECK(cells.cellCount() == 2 + 7 + 7 + 7);
  size_t largest = 0;
  for (size_t c = cells.cutCells; c < cells.cellCount(); ++c) {
    if (cells.cellVolume[c] == 64) largest = std::max(largest, cells.halfFaces(c).size());
  }
  CHECK(largest == 6 + 3);
}

TEST_CASE("cell complex: a few octree cells in a large grid", "[cellcomplex]") {
  checkedComplex(shapes::icosphere({130, 125, 128}, 2.2, 1), unitGrid(256), levels(24));
}

TEST_CASE("cell complex: the same to the bit for any number of threads", "[cellcomplex]") {
  const Mesh ball = shapes::icosphere({12, 11, 13}, 6.2, 2);
  const CutResult result = cut(ball, unitGrid(25));
  for (const int maxLevel : {0, 24}) {
    const OctreeCells octree = coarsen(result.mesh, levels(maxLevel));
    const auto bytesWith = [&](unsigned threads) {
      RunOptions options;
      options.threads = threads;
      return bytesOfFields(cellComplex(ball, result.mesh, octree, options));
    };
    const auto one = bytesWith(1);
    CHECK(bytesWith(2) == one);
    CHECK(bytesWith(3) == one);
  }
}

TEST_CASE("cell complex: what does not belong together is refused", "[cellcomplex]") {
  const Mesh mesh = shapes::cube(1.25, 2.5), otherMesh = shapes::cube(0.25, 0.5);
  const CutResult small = cut(mesh, unitGrid(4)), other = cut(otherMesh, unitGrid(4));
  REQUIRE_THROWS_AS(cellComplex(mesh, small.mesh, coarsen(cut(mesh, unitGrid(5)).mesh)), CallError);
  REQUIRE_THROWS_AS(cellComplex(mesh, small.mesh, coarsen(other.mesh)), CallError);
  REQUIRE_THROWS_AS(cellComplex(mesh, CutMesh(), OctreeCells()), CallError);
  RunOptions options;
  options.progress = [](const Progress&) { return false; };
  REQUIRE_THROWS_AS(cellComplex(mesh, small.mesh, coarsen(small.mesh), options), CallError);
}

TEST_CASE("cell complex: octree cells that are out of order, there twice, inside each other or lacking are refused", "[cellcomplex]") {
  const Mesh mesh = shapes::cube(1.25, 2.5);
  const CutResult result = cut(mesh, unitGrid(8));
  const OctreeCells octree = coarsen(result.mesh);
  const auto isRefused = [&](const auto& damage) {
    OctreeCells damaged = octree;
    damage(damaged);
    try {
      cellComplex(mesh, result.mesh, damaged);
    } catch (const CallError& failure) {
      return failure.error.status == Status::badArgument;
    }
    return false;
  };
  const auto copyCell = [](OctreeCells& cells, size_t from, size_t to) {
    for (size_t d = 0; d < 3; ++d) cells.cellCorner[3 * to + d] = cells.cellCorner[3 * from + d];
    cells.cellLevel[to] = cells.cellLevel[from];
  };
  const size_t last = octree.cellCount() - 1;
  REQUIRE(octree.cellLevel[last] > 0);
  CHECK(isRefused([&](OctreeCells& cells) { copyCell(cells, last, 0); }));
  CHECK(isRefused([&](OctreeCells& cells) { copyCell(cells, last, last - 1); }));
  CHECK(isRefused([&](OctreeCells& cells) { cells.cellLevel[last - 1] = 3; }));
  CHECK(isRefused([&](OctreeCells& cells) { cells.cellCorner[3 * last] = 8; }));
  CHECK(isRefused([&](OctreeCells& cells) { cells.cellCorner[3 * last] = -4; }));
  CHECK(isRefused([](OctreeCells& cells) {  // away from the surface
    cells.cellCorner.resize(cells.cellCorner.size() - 3);
    cells.cellLevel.pop_back();
    cells.cellRegion.pop_back();
  }));
  CHECK_FALSE(isRefused([](OctreeCells&) {}));
}
