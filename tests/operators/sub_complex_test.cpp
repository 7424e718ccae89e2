// Parts of a cell complex, with maps back.
#include "case_list.h"
#include "checked_cut.h"
#include "conforming_cells.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

template <class Item>
void requireItems(const std::vector<Item>& part, const std::vector<Item>& whole, const std::vector<uint32_t>& ids, size_t stride) {
  REQUIRE(part.size() == stride * ids.size());
  bool same = true;
  for (size_t i = 0; i < part.size(); ++i) same &= part[i] == whole[stride * ids[i / stride] + i % stride];
  REQUIRE(same);
}

/// That the part is the whole's, element for element.
void requirePart(const SubComplex& sub, const CellComplex& whole) {
  const CellComplex& part = sub.cells;
  requireClosedCells(part);
  requireItems(part.positions, whole.positions, sub.wholeVertex, 3);
  requireItems(part.faceTag, whole.faceTag, sub.wholeFace, 1);
  requireItems(part.faceArea, whole.faceArea, sub.wholeFace, 1);
  requireItems(part.faceNormal, whole.faceNormal, sub.wholeFace, 3);
  requireItems(part.faceCentroid, whole.faceCentroid, sub.wholeFace, 3);
  requireItems(part.cellCorner, whole.cellCorner, sub.wholeCell, 3);
  requireItems(part.cellLevel, whole.cellLevel, sub.wholeCell, 1);
  requireItems(part.cellCentre, whole.cellCentre, sub.wholeCell, 3);
  requireItems(part.cellRegion, whole.cellRegion, sub.wholeCell, 1);
  requireItems(part.cellVolume, whole.cellVolume, sub.wholeCell, 1);
  requireItems(part.cellCentroid, whole.cellCentroid, sub.wholeCell, 3);
  for (size_t c = 0; c < part.cellCount(); ++c) {
    const auto mine = part.halfFaces(c), theirs = whole.halfFaces(sub.wholeCell[c]);
    REQUIRE(mine.size() == theirs.size());
    for (size_t i = 0; i < mine.size(); ++i) {
      REQUIRE(2 * sub.wholeFace[mine[i] / 2] + mine[i] % 2 == theirs[i]);
      REQUIRE(part.faceCells[mine[i]] == int32_t(c));
    }
  }
  for (size_t f = 0; f < part.faceCount(); ++f) {
    std::vector<uint32_t> mine, theirs;
    for (const auto loop : part.loops(f)) {
      for (const uint32_t v : loop) mine.push_back(sub.wholeVertex[v]);
    }
    for (const auto loop : whole.loops(sub.wholeFace[f])) theirs.insert(theirs.end(), loop.begin(), loop.end());
    REQUIRE(mine == theirs);
    REQUIRE((part.faceCells[2 * f] >= 0 || part.faceCells[2 * f + 1] >= 0));
  }
}

}  // namespace

TEST_CASE("sub-mesh: the regions of all cases", "[cellcomplex]") {
  for (const NamedCase& c : caseList()) {
    CAPTURE(c.name);
    const CutResult result = cut(c.mesh, c.grid);
    const CellComplex whole = cellComplex(c.mesh, result.mesh, coarsen(result.mesh));
    size_t cells = 0, cutFaces = 0, inner = 0, wholeInner = 0;
    for (uint32_t r = 0; r < result.mesh.regionCount; ++r) {
      const SubComplex sub = regionComplex(whole, r);
      requirePart(sub, whole);
      cells += sub.cells.cellCount();
      for (size_t f = 0; f < sub.cells.faceCount(); ++f) {
        if (sub.cells.faceTag[f] == FaceTag::inner) {
          ++inner;
          REQUIRE((sub.cells.faceCells[2 * f] >= 0 && sub.cells.faceCells[2 * f + 1] >= 0));  // regions end at the surface
        }
      }
      cutFaces += sub.cells.cutFaces;
    }
    for (const FaceTag tag : whole.faceTag) wholeInner += tag == FaceTag::inner;
    CHECK(cells == whole.cellCount());
    CHECK(inner == wholeInner);
    CHECK(cutFaces >= whole.cutFaces);
  }
}

TEST_CASE("sub-mesh: cells in any order, cut off from their neighbours", "[cellcomplex]") {
  const Mesh ball = shapes::icosphere({3.3, 3.1, 2.9}, 1.7, 2);
  const CutResult result = cut(ball, unitGrid(7));
  const CellComplex whole = cellComplex(ball, result.mesh, coarsen(result.mesh));
  const std::vector<uint32_t> ids = {uint32_t(whole.cellCount()) - 1, 4, 17, 0};
  const SubComplex sub = subComplex(whole, ids);
  CHECK(sub.wholeCell == std::vector<uint32_t>{0, 4, 17, uint32_t(whole.cellCount()) - 1});
  CHECK(sub.cells.cutCells == 3);
  requirePart(sub, whole);
  CHECK(subComplex(whole, {}).cells.cellCount() == 0);
}

TEST_CASE("sub-mesh: cells that do not exist or come twice are refused", "[cellcomplex]") {
  const Mesh cube = shapes::cube(1.25, 2.5);
  const CutResult result = cut(cube, unitGrid(4));
  const CellComplex whole = cellComplex(cube, result.mesh, coarsen(result.mesh));
  const uint32_t count = uint32_t(whole.cellCount());
  const auto take = [&](std::vector<uint32_t> ids) { return refusal([&] { subComplex(whole, ids); }); };
  CHECK(take({0, count}).second == count);
  CHECK(take({3, 1, 3}).second == 3);
  CHECK(take({3, 1, 3}).first == Status::badArgument);
  CHECK(refusal([&] { regionComplex(whole, 2); }).second == 2);
}
