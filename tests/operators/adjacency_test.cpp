// Adjacency: owners of faces, untouched grid cells beside them, and neighbours of cut-cells.
#include <algorithm>

#include "catch.h"
#include "checked_cut.h"
#include "mandoline/measure.h"
#include "shapes.h"

using namespace mandoline;

namespace {

CutMesh cutOf(const Mesh& mesh, const Grid& grid) {
  const CutResult result = cut(mesh, grid);
  REQUIRE(result.error.message == "");
  return result.mesh;
}

std::vector<uint32_t> neighboursOf(const Adjacency& adjacent, uint32_t cell) {
  return {adjacent.cellCells.begin() + adjacent.cellCellOffsets[cell], adjacent.cellCells.begin() + adjacent.cellCellOffsets[cell + 1]};
}

void requireConsistent(const CutMesh& mesh) {
  const Adjacency adjacent = adjacency(mesh);
  const std::vector<int32_t> gridCellRegion = mesh.gridCellRegion();
  REQUIRE(adjacent.faceCells.size() == 2 * mesh.faceCount());
  REQUIRE(adjacent.faceGridCells.size() == 2 * mesh.faceCount());
  REQUIRE(adjacent.cellCellOffsets.size() == mesh.cellCount() + 1);
  size_t owned = 0, wrong = 0;
  std::vector<std::vector<uint32_t>> expected(mesh.cellCount());
  for (size_t h = 0; h < 2 * mesh.faceCount(); ++h) {
    const int32_t cell = adjacent.faceCells[h], opposite = adjacent.faceCells[h ^ 1];
    const int64_t gridCell = adjacent.faceGridCells[h];
    if (cell >= 0) {
      ++owned;
      const auto halfFaces = mesh.halfFaces(size_t(cell));
      wrong += std::count(halfFaces.begin(), halfFaces.end(), h) != 1 || gridCell != -1;
      if (opposite >= 0 && cell != opposite) expected[cell].push_back(uint32_t(opposite));
    } else if (gridCell >= 0) {
      // An untouched grid cell belongs to the region on the other side of a face that is not mesh.
      wrong += gridCell >= int64_t(gridCellRegion.size()) || gridCellRegion[gridCell] < 0 || opposite < 0;
      if (opposite >= 0 && mesh.faceTriangle[h / 2] < 0) wrong += gridCellRegion[gridCell] != int32_t(mesh.cellRegion[opposite]);
    } else {
      const int axis = mesh.faceAxis[h / 2];
      wrong += axis < 0 || (mesh.facePlane[h / 2] != 0 && mesh.facePlane[h / 2] != mesh.grid.cells(axis));
    }
  }
  CHECK(owned == mesh.cellHalfFaces.size());
  CHECK(wrong == 0);
  for (uint32_t c = 0; c < mesh.cellCount(); ++c) {
    std::sort(expected[c].begin(), expected[c].end());
    expected[c].erase(std::unique(expected[c].begin(), expected[c].end()), expected[c].end());
    wrong += neighboursOf(adjacent, c) != expected[c];
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("adjacency: a bubble's only neighbour is the cell around it", "[adjacency]") {
  const CutMesh mesh = cutOf(shapes::icosphere({1.5, 1.5, 1.5}, 0.3, 1), unitGrid(3));
  REQUIRE(mesh.cellCount() == 2);
  const Adjacency adjacent = adjacency(mesh);
  CHECK(neighboursOf(adjacent, 0) == std::vector<uint32_t>{1});
  CHECK(neighboursOf(adjacent, 1) == std::vector<uint32_t>{0});
  std::vector<int64_t> gridCells = adjacent.faceGridCells;
  gridCells.erase(std::remove(gridCells.begin(), gridCells.end(), -1), gridCells.end());
  std::sort(gridCells.begin(), gridCells.end());
  CHECK(gridCells == std::vector<int64_t>{4, 10, 12, 14, 16, 22});
}

TEST_CASE("adjacency: a cell is not beside itself across a partial cut", "[adjacency]") {
  const CutMesh mesh = cutOf(shapes::quad({0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.8, 0.8, 0.5}, {0.2, 0.8, 0.5}), unitGrid(1));
  REQUIRE(mesh.cellCount() == 1);
  const Adjacency adjacent = adjacency(mesh);
  CHECK(adjacent.cellCells.empty());
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    const bool triFace = mesh.faceTriangle[f] >= 0;
    CHECK(adjacent.faceCells[2 * f] == (triFace || mesh.facePlane[f] == 1 ? 0 : -1));
    CHECK(adjacent.faceCells[2 * f + 1] == (triFace || mesh.facePlane[f] == 0 ? 0 : -1));
    CHECK(adjacent.faceGridCells[2 * f] == -1);
    CHECK(adjacent.faceGridCells[2 * f + 1] == -1);
  }
}

TEST_CASE("adjacency: owners and neighbours agree with the half-faces", "[adjacency]") {
  SECTION("a sphere") { requireConsistent(cutOf(shapes::noisySphere({2.5, 2.5, 2.5}, 1.7, 0.1, 3), unitGrid(5))); }
  SECTION("a mesh partly outside") { requireConsistent(cutOf(shapes::icosphere({0, 1.5, 3}, 1.4, 2), unitGrid(3, 4, 5))); }
  SECTION("coplanar triangles") {
    requireConsistent(cutOf(shapes::cube(1, 3), unitGrid(4)));
    requireConsistent(cutOf(shapes::flipped(shapes::cube(0, 4)), unitGrid(4)));
  }
  SECTION("sheets") { requireConsistent(cutOf(shapes::moebius({2.5, 2.5, 2.5}, 1.6, 0.6, 24), unitGrid(5))); }
  SECTION("outside of the grid") {
    const CutMesh mesh = cutOf(shapes::cube(10, 11), unitGrid(2));
    requireConsistent(mesh);
    CHECK(adjacency(mesh).cellCellOffsets == std::vector<uint32_t>{0});
  }
}
