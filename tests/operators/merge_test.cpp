// Small cells merged: bounds of volumes, what is never merged, and that the mesh stays conforming. All is worked out anew from the cells
// before and after.
#include "mandoline/merge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
#include "conforming_cells.h"
#include "mandoline/inside.h"
#include "mandoline/mesh_files.h"
#include "mandoline/resolve.h"
#include "mesh_folder.h"
#include "refusal.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

CellComplex complexOf(const Mesh& mesh, const CutMesh& cutMesh, int maxLevel = 24) {
  CoarsenOptions options;
  options.maxLevel = maxLevel;
  options.fineLayers = options.layersPerLevel = 0;
  return cellComplex(mesh, cutMesh, coarsen(cutMesh, options));
}

/// Volume of the grid cell or octree cell of a cell before.
double unitOf(const CutMesh& cutMesh, const CellComplex& before, uint32_t cell) {
  if (cell >= before.cutCells) return before.cellVolume[cell];
  double volume = 1;
  for (size_t d = 0; d < 3; ++d) {
    const double* plane = &cutMesh.grid.planes[d][size_t(before.cellCorner[3 * cell + d])];
    volume *= plane[1] - plane[0];
  }
  return volume;
}

/// The member that is the base.
uint32_t baseOf(const CellComplex& before, const Members& members) {
  uint32_t base = members[0];
  for (const uint32_t m : members) {
    if (m >= before.cutCells || (base < before.cutCells && before.cellVolume[m] > before.cellVolume[base])) base = m;
  }
  return base;
}

class MergeCheck {
 public:
  MergeCheck(const CutMesh& cutMesh, const CellComplex& before, const MergedCells& merged, double fraction)
      : cutMesh_(cutMesh), before_(before), merged_(merged), after_(merged.cells), fraction_(fraction) {}

  void run() {
    REQUIRE(checkArrays(after_).message.empty());
    requireCells();
    requireNotEmpty();
    requireClosedCells(after_);
    requireOnePiece();
    requireBounds();
    requireNothingLeft();
  }

 private:
  void requireCells() {
    REQUIRE(merged_.mergedCell.size() == before_.cellCount());
    std::vector<size_t> found(before_.cellCount());
    for (uint32_t c = 0; c < after_.cellCount(); ++c) {
      CAPTURE(c);
      const Members members = after_.membersOfCell(c);
      double volume = 0, moment[3] = {};
      size_t octreeCells = 0;
      for (const uint32_t m : members) {
        ++found[m];
        octreeCells += m >= before_.cutCells;
        volume += before_.cellVolume[m];
        for (size_t d = 0; d < 3; ++d) moment[d] += before_.cellVolume[m] * before_.cellCentroid[3 * m + d];
        REQUIRE(merged_.mergedCell[m] == c);
        REQUIRE(before_.cellRegion[m] == after_.cellRegion[c]);
      }
      REQUIRE(octreeCells <= 1);
      REQUIRE((c < after_.cutCells) == (members[0] < before_.cutCells));
      REQUIRE(after_.cellVolume[c] == volume);
      const uint32_t base = baseOf(before_, members);
      for (size_t d = 0; d < 3; ++d) {
        REQUIRE(after_.cellCentroid[3 * c + d] * volume == Approx(moment[d]).margin(1e-12 * std::fabs(volume)));
        REQUIRE(after_.cellCorner[3 * c + d] == before_.cellCorner[3 * base + d]);
        REQUIRE(after_.cellCentre[3 * c + d] == before_.cellCentre[3 * base + d]);
      }
      REQUIRE(after_.cellLevel[c] == before_.cellLevel[base]);
    }
    REQUIRE(std::count(found.begin(), found.end(), 1u) == std::ptrdiff_t(found.size()));
  }

  int32_t cellAfter(size_t halfFace) const {
    const int32_t cell = before_.faceCells[halfFace];
    return cell < 0 ? -1 : int32_t(merged_.mergedCell[size_t(cell)]);
  }

  /// Every face is part of one, unless it is no triangle and lies inside a cell; and triangles have the same cell on both sides only where
  /// they had before.
  void requireNotEmpty() {
    std::vector<size_t> found(before_.faceCount());
    for (size_t f = 0; f < after_.faceCount(); ++f) {
      CAPTURE(f);
      const Members members = after_.membersOfFace(f);
      double area = 0;
      for (const uint32_t m : members) {
        ++found[m];
        area += before_.faceArea[m];
        REQUIRE(before_.faceTag[m] == after_.faceTag[f]);
        for (size_t side = 0; side < 2; ++side) REQUIRE(after_.faceCells[2 * f + side] == cellAfter(2 * size_t(m) + side));
        for (size_t d = 0; d < 3; ++d) REQUIRE(before_.faceNormal[3 * m + d] == after_.faceNormal[3 * f + d]);
      }
      REQUIRE(after_.faceArea[f] == Approx(area).epsilon(1e-14));
      REQUIRE((members.size() == 1 || after_.loops(f).size() == 1));
      REQUIRE((f < after_.cutFaces) == (members[0] < before_.cutFaces));
    }
    for (size_t f = 0; f < found.size(); ++f) {
      CAPTURE(f);
      const bool isSurface = before_.faceTag[f] == FaceTag::surface, isInside = cellAfter(2 * f) == cellAfter(2 * f + 1);
      REQUIRE(found[f] == (isSurface || !isInside ? 1 : 0));
      if (isSurface && isInside) REQUIRE(before_.faceCells[2 * f] == before_.faceCells[2 * f + 1]);
    }
  }

  /// The members of a cell hang together through faces that vanish.
  void requireOnePiece() const {
    std::vector<uint32_t> next(before_.cellCount()), found(after_.cellCount());
    const auto root = [&](uint32_t c) {
      while (next[c] != c) c = next[c] = next[next[c]];
      return c;
    };
    std::iota(next.begin(), next.end(), 0u);
    for (size_t f = 0; f < before_.faceCount(); ++f) {
      if (before_.faceTag[f] != FaceTag::surface && cellAfter(2 * f) >= 0 && cellAfter(2 * f) == cellAfter(2 * f + 1))
        next[root(uint32_t(before_.faceCells[2 * f]))] = root(uint32_t(before_.faceCells[2 * f + 1]));
    }
    for (uint32_t c = 0; c < next.size(); ++c) found[merged_.mergedCell[c]] += root(c) == c;
    REQUIRE(std::count(found.begin(), found.end(), 1u) == std::ptrdiff_t(found.size()));
  }

  double volumeByUnit(size_t c) const { return after_.cellVolume[c] / unitOf(cutMesh_, before_, baseOf(before_, after_.membersOfCell(c))); }

  void requireBounds() {
    const std::set<uint32_t> pockets(merged_.pockets.begin(), merged_.pockets.end());
    REQUIRE(pockets.size() == merged_.pockets.size());
    for (uint32_t c = 0; c < after_.cellCount(); ++c) {
      CAPTURE(c, volumeByUnit(c));
      REQUIRE((volumeByUnit(c) < fraction_) == (pockets.count(c) > 0));
      REQUIRE(volumeByUnit(c) <= (1 + 2.5 * fraction_) * (1 + 1e-14));
    }
  }

  /// A pocket can't join any of its neighbours.
  void requireNothingLeft() {
    for (const uint32_t c : merged_.pockets) {
      std::set<int32_t> beside, separated;
      for (const uint32_t h : after_.halfFaces(c)) {
        const int32_t other = after_.faceCells[h ^ 1];
        (after_.faceTag[h / 2] == FaceTag::surface ? separated : beside).insert(other);
      }
      for (const int32_t other : beside) {
        if (other < 0 || separated.count(other) || after_.cellRegion[size_t(other)] != after_.cellRegion[c]) continue;
        CAPTURE(c, other);
        const uint32_t bases[] = {baseOf(before_, after_.membersOfCell(c)), baseOf(before_, after_.membersOfCell(size_t(other)))};
        const bool isLarger = bases[1] >= before_.cutCells || before_.cellVolume[bases[1]] > before_.cellVolume[bases[0]];
        const double all = after_.cellVolume[c] + after_.cellVolume[size_t(other)];
        REQUIRE(all / unitOf(cutMesh_, before_, bases[isLarger]) > 1 + 2.5 * fraction_);
      }
    }
  }

  const CutMesh& cutMesh_;
  const CellComplex& before_;
  const MergedCells& merged_;
  const CellComplex& after_;
  const double fraction_;
};

/// The same volume per region, to rounding.
void requireRegionVolumes(const CutMesh& cutMesh, const CellComplex& before, const CellComplex& after) {
  std::vector<double> volumes[2];
  for (const CellComplex* cells : {&before, &after}) {
    std::vector<double>& mine = volumes[cells == &after];
    mine.resize(cutMesh.regionCount);
    for (size_t c = 0; c < cells->cellCount(); ++c) mine[cells->cellRegion[c]] += cells->cellVolume[c];
  }
  for (size_t r = 0; r < cutMesh.regionCount; ++r) REQUIRE(volumes[1][r] == Approx(volumes[0][r]).epsilon(1e-13));
}

MergedCells checkedMerge(const Mesh& mesh, const CutMesh& cutMesh, const CellComplex& before, double fraction = 0.2) {
  MergeOptions options;
  options.fraction = fraction;
  const MergedCells merged = mergeSmallCells(cutMesh, before, options);
  MergeCheck(cutMesh, before, merged, fraction).run();
  requireAreasAndVolumes(merged.cells, mesh, cutMesh);
  requireRegionVolumes(cutMesh, before, merged.cells);
  return merged;
}

MergedCells checkedMerge(const Mesh& mesh, const Grid& grid, int maxLevel = 24, double fraction = 0.2) {
  const CutResult result = cut(mesh, grid);
  REQUIRE(result);
  return checkedMerge(mesh, result.mesh, complexOf(mesh, result.mesh, maxLevel), fraction);
}

/// In degrees, between the normals of faces and the lines between the centroids of their cells.
double largestAngle(const CellComplex& cells) {
  double largest = 0;
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    const int32_t a = cells.faceCells[2 * f], b = cells.faceCells[2 * f + 1];
    if (cells.faceTag[f] == FaceTag::surface || a < 0 || b < 0) continue;
    double along = 0, square = 0;
    for (size_t d = 0; d < 3; ++d) {
      const double line = cells.cellCentroid[3 * size_t(b) + d] - cells.cellCentroid[3 * size_t(a) + d];
      along += line * cells.faceNormal[3 * f + d];
      square += line * line;
    }
    largest = std::max(largest, std::acos(along / std::sqrt(square)) * 180 / std::acos(-1.0));
  }
  return largest;
}

/// Of cells in a region.
std::map<double, size_t> volumesOf(const CellComplex& cells, uint32_t region) {
  std::map<double, size_t> volumes;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    if (cells.cellRegion[c] == region) ++volumes[cells.cellVolume[c]];
  }
  return volumes;
}

}  // namespace

TEST_CASE("merge: all cases, single grid cells and octree cells", "[merge]") {
  for (const NamedCase& c : caseList()) {
    CAPTURE(c.name);
    checkedMerge(c.mesh, c.grid, 0);
    checkedMerge(c.mesh, c.grid, 24);
    checkedMerge(c.mesh, c.grid, 24, 0.5);
  }
}

TEST_CASE("merge: a box slightly larger than eight grid cells becomes eight cells", "[merge]") {
  const Mesh box = shapes::cube(0.9375, 3.0625);
  const CutResult result = cut(box, unitGrid(4));
  const CellComplex before = complexOf(box, result.mesh, 0);
  const MergedCells merged = checkedMerge(box, result.mesh, before);
  const uint32_t inside = result.mesh.regionWinding[0] == 1 ? 0 : 1;
  CHECK(volumesOf(before, inside).size() == 4);
  CHECK(volumesOf(merged.cells, inside) == std::map<double, size_t>{{1.0625 * 1.0625 * 1.0625, 8}});
  // The 12 sides between them were 4 faces each.
  size_t sides = 0;
  for (size_t f = 0; f < merged.cells.faceCount(); ++f) {
    const int32_t front = merged.cells.faceCells[2 * f];
    if (merged.cells.faceTag[f] != FaceTag::inner || merged.cells.cellRegion[size_t(front)] != inside) continue;
    ++sides;
    CHECK(merged.cells.membersOfFace(f).size() == 4);
    CHECK(merged.cells.faceArea[f] == 1.0625 * 1.0625);
  }
  CHECK(sides == 12);
  CHECK(merged.pockets.empty());
}

TEST_CASE("merge: a closed pocket stays, and is named", "[merge]") {
  const Mesh pocket = shapes::cube(1.25, 1.75);
  const MergedCells merged = checkedMerge(pocket, unitGrid(4), 0);
  REQUIRE(merged.pockets.size() == 1);
  CHECK(merged.cells.cellVolume[merged.pockets[0]] == 0.125);
}

TEST_CASE("merge: a small cell whose neighbour has no room stays", "[merge]") {
  // Three bars that cross in a grid cell, which has 0.84375 of its volume, and reach 0.2 beyond it: six ends of 0.1125. Five fit below 1.5.
  std::vector<Mesh> bars;
  for (size_t d = 0; d < 3; ++d) {
    shapes::Point low{1.125, 1.125, 1.125}, high{1.875, 1.875, 1.875};
    low[d] = 0.8, high[d] = 2.2;
    bars.push_back(shapes::box(low, high));
  }
  const Mesh crossing = shapes::merged(bars), cross = boundary(resolve(crossing).mesh);
  const MergedCells merged = checkedMerge(cross, unitGrid(3), 0);
  REQUIRE(merged.pockets.size() == 1);
  CHECK(merged.cells.cellVolume[merged.pockets[0]] == Approx(0.1125));
}

TEST_CASE("merge: never across a triangle, where a sheet ends in a cell, nor around its rim", "[merge]") {
  // The cells above and below the sheet are 0.0625 high, those at its rim have both sides.
  const Mesh sheet = shapes::quad({0.5, 0.5, 2.0625}, {3.5, 0.5, 2.0625}, {3.5, 3.5, 2.0625}, {0.5, 3.5, 2.0625});
  const CutResult result = cut(sheet, unitGrid(4));
  const CellComplex before = complexOf(sheet, result.mesh, 0);
  const MergedCells merged = checkedMerge(sheet, result.mesh, before);
  CHECK(merged.cells.cellCount() == before.cellCount() - 4);  // those below the sheet
}

TEST_CASE("merge: of two small cells on both sides of a sheet, one joins the cell at its rim", "[merge]") {
  // A flat channel in one layer of cells, and a sheet half-way up, from its closed end to within the second cell.
  const Mesh channel = shapes::box({2.25, 0.125, 0.375}, {7.75, 0.875, 0.6875});
  const Mesh sheet = shapes::quad({1.5, 0, 0.53125}, {3.5, 0, 0.53125}, {3.5, 1, 0.53125}, {1.5, 1, 0.53125});
  const Mesh both = shapes::merged({channel, sheet});
  const CutResult result = cut(both, unitGrid(9, 1, 1));
  REQUIRE(result);
  const CellComplex before = complexOf(both, result.mesh, 0);
  const MergedCells merged = checkedMerge(both, result.mesh, before);
  const double half = 0.75 * 0.75 * 0.15625;
  CHECK(std::count(before.cellVolume.begin(), before.cellVolume.end(), half) == 2);
  REQUIRE(merged.pockets.size() == 1);
  CHECK(merged.cells.cellVolume[merged.pockets[0]] == half);
}

TEST_CASE("merge: never across regions that an estimate of what is inside divides at holes", "[merge]") {
  Mesh ball = shapes::noisySphere({4, 4, 4}, 2.7, 0.2, 3);
  ball.triangles.resize(ball.triangles.size() / 4 * 3);
  const CutResult result = cut(ball, unitGrid(8));
  REQUIRE(result.mesh.regionCount == 1);
  const CutMesh divided = estimateInside(ball, result.mesh, {});
  REQUIRE(divided.regionCount > 1);
  checkedMerge(ball, divided, complexOf(ball, divided), 0.5);
}

TEST_CASE("merge: octree cells take small ones in", "[merge]") {
  // The box has 4^3 octree cells of level 1 inside, and around them plates of 0.0625 and what is in its edges and corners.
  const Mesh box = shapes::cube(3.9375, 12.0625);
  const CutResult result = cut(box, unitGrid(16));
  const MergedCells merged = checkedMerge(box, result.mesh, complexOf(box, result.mesh, 1));
  const std::map<double, size_t> inside = volumesOf(merged.cells, result.mesh.regionWinding[0] == 1 ? 0 : 1);
  CHECK(inside.at(8) == 8);
  CHECK(std::all_of(inside.begin(), inside.end(), [](const auto& each) { return each.first >= 8; }));
}

TEST_CASE("merge: in a shell of a tenth of a grid cell no face is too far from perpendicular to the line between centroids", "[merge]") {
  const shapes::Point centre{8.1, 8.2, 8.3};
  for (const double radius : {3.3, 5.2}) {
    CAPTURE(radius);
    for (const double thickness : {0.1, 0.15}) {
      CAPTURE(thickness);
      const Mesh inner = shapes::flipped(shapes::icosphere(centre, radius - thickness, 3));
      const MergedCells merged = checkedMerge(shapes::merged({shapes::icosphere(centre, radius, 3), inner}), unitGrid(16), 0);
      CHECK(largestAngle(merged.cells) < 70);
    }
  }
}

TEST_CASE("merge: a gap of next to nothing between two boxes is divided among the cells around it", "[merge]") {
  const Mesh low = shapes::box({1.5, 1.5, 1.5}, {8.5, 8.5, 4.5}), high = shapes::box({2.5, 2.5, 4.501}, {7.5, 7.5, 7.5});
  const MergedCells merged = checkedMerge(shapes::merged({low, high}), unitGrid(10), 0);
  CHECK(merged.pockets.empty());
  CHECK(largestAngle(merged.cells) < 70);
}

TEST_CASE("merge: graded grids", "[merge]") {
  std::array<std::vector<double>, 3> planes;
  for (size_t d = 0; d < 3; ++d) {
    double x = 0;
    for (int i = 0; i <= 12; ++i, x += 0.5 + 0.125 * double(i % 5)) planes[d].push_back(x);
  }
  checkedMerge(shapes::icosphere({4.1, 4.2, 4.3}, 2.7, 3), Grid::rectilinear(planes), 24);
}

TEST_CASE("merge: nothing is small at fraction 0", "[merge]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 2);
  const CutResult result = cut(ball, unitGrid(8));
  const CellComplex before = complexOf(ball, result.mesh);
  const CellComplex after = checkedMerge(ball, result.mesh, before, 0).cells;
  CHECK(after.faceCells == before.faceCells);
  CHECK(after.loopVertices == before.loopVertices);
  CHECK(after.cellHalfFaces == before.cellHalfFaces);
  CHECK(after.cellVolume == before.cellVolume);
}

TEST_CASE("merge: parts of merged cells, and the fingerprint", "[merge]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 2);
  const CutResult result = cut(ball, unitGrid(8));
  const CellComplex before = complexOf(ball, result.mesh);
  const CellComplex merged = mergeSmallCells(result.mesh, before).cells;
  CHECK(merged.madeFrom == before.madeFrom);
  CHECK(merged.fingerprint != before.fingerprint);
  CHECK(merged.fingerprint != mergeSmallCells(result.mesh, before, MergeOptions{{}, 0.25}).cells.fingerprint);
  const SubComplex sub = regionComplex(merged, 1);
  CHECK(checkArrays(sub.cells).message.empty());
  requireClosedCells(sub.cells);
  for (size_t c = 0; c < sub.cells.cellCount(); ++c) {
    const Members mine = sub.cells.membersOfCell(c), whole = merged.membersOfCell(sub.wholeCell[c]);
    REQUIRE(mine.size() == whole.size());
    for (size_t i = 0; i < mine.size(); ++i) REQUIRE(mine[i] == whole[i]);
  }
  const Members face = sub.cells.membersOfFace(0);
  CHECK(face[0] == merged.membersOfFace(sub.wholeFace[0])[0]);
}

TEST_CASE("merge: wrong options, and cells that are merged already or others'", "[merge]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 2);
  const CutResult result = cut(ball, unitGrid(8)), other = cut(ball, unitGrid(9));
  const CellComplex before = complexOf(ball, result.mesh);
  for (const double fraction : {-0.1, 0.51, double(NAN)}) {
    CHECK(refusal([&] { mergeSmallCells(result.mesh, before, MergeOptions{{}, fraction}); }).first == Status::badOption);
  }
  const MergedCells merged = mergeSmallCells(result.mesh, before);
  CHECK(refusal([&] { mergeSmallCells(result.mesh, merged.cells); }).first == Status::badArgument);
  CHECK(refusal([&] { mergeSmallCells(other.mesh, before); }).first == Status::badArgument);
  CHECK(refusal([&] { mergeSmallCells(result.mesh, regionComplex(before, 1).cells); }).first == Status::badArgument);
  MergeOptions cancelled;
  cancelled.progress = [](const Progress&) { return false; };
  CHECK(refusal([&] { mergeSmallCells(result.mesh, before, cancelled); }).first == Status::cancelled);
}

TEST_CASE("merge: what is wrong with members is named", "[merge]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 2);
  const CutResult result = cut(ball, unitGrid(8));
  const MergedCells merged = mergeSmallCells(result.mesh, complexOf(ball, result.mesh));
  const auto messageAfter = [&](auto damage) {
    CellComplex cells = merged.cells;
    damage(cells);
    return checkArrays(cells).message;
  };
  CHECK(messageAfter([](CellComplex&) {}).empty());
  CHECK(!messageAfter([](CellComplex& cells) { cells.cellMembers.back() = cells.cellMembers.front(); }).empty());
  CHECK(!messageAfter([](CellComplex& cells) { cells.cellMembers.back() = ~0u; }).empty());
  CHECK(!messageAfter([](CellComplex& cells) { cells.cellMemberOffsets[1] = 0; }).empty());
  CHECK(!messageAfter([](CellComplex& cells) { cells.faceMembers.back() = cells.faceMembers.front(); }).empty());
  CHECK(!messageAfter([](CellComplex& cells) { cells.cellMemberOffsets.pop_back(); }).empty());
}

TEST_CASE("merge: real meshes, coarsened", "[merge]") {
  const auto folder = meshFolder();
  if (!folder) return;
  for (const char* name : {"common_spot", "codim_skirt8K", "assimp_Wuson", "cgal_bones", "trimesh_chair_model", "trimesh_angle_block",
                           "manifold_self_intersectA", "igltut_truck"}) {
    CAPTURE(name);
    const Mesh mesh = readMesh((*folder / (std::string(name) + ".obj.gz")).string());
    checkedMerge(mesh, Grid::around(mesh, 24), 3);
  }
}

namespace {

/// What is between the same two cells and of one group, and how large.
void requireUnited(const Mesh& mesh, const CutMesh& cutMesh, const CellComplex& before, const CellComplex& after) {
  REQUIRE(checkArrays(after).message.empty());
  requireClosedCells(after);
  requireAreasAndVolumes(after, mesh, cutMesh);
  CHECK(after.cellVolume == before.cellVolume);
  CHECK(after.cellMembers == before.cellMembers);
  std::map<uint32_t, size_t> faceOf;  // per member of a face before
  for (size_t f = 0; f < before.faceCount(); ++f) {
    for (const uint32_t m : before.membersOfFace(f)) faceOf[m] = f;
  }
  std::set<uint32_t> found;
  for (size_t f = 0; f < after.faceCount(); ++f) {
    CAPTURE(f);
    double area[3] = {};
    std::set<size_t> pieces;
    for (const uint32_t m : after.membersOfFace(f)) {
      REQUIRE(found.insert(m).second);
      pieces.insert(faceOf.at(m));
    }
    for (const size_t piece : pieces) {
      REQUIRE(after.faceTag[f] == before.faceTag[piece]);
      for (size_t side = 0; side < 2; ++side) REQUIRE(after.faceCells[2 * f + side] == before.faceCells[2 * piece + side]);
      for (size_t d = 0; d < 3; ++d) area[d] += before.faceArea[piece] * before.faceNormal[3 * piece + d];
    }
    REQUIRE((pieces.size() == 1 || (after.faceTag[f] == FaceTag::surface && after.loops(f).size() == 1)));
    for (size_t d = 0; d < 3; ++d)
      REQUIRE(after.faceArea[f] * after.faceNormal[3 * f + d] == Approx(area[d]).margin(1e-13 * (1 + after.faceArea[f])));
  }
  REQUIRE(found.size() == faceOf.size());
}

/// How many faces a surface has.
size_t wallsOf(const CellComplex& cells) { return size_t(std::count(cells.faceTag.begin(), cells.faceTag.end(), FaceTag::surface)); }

}  // namespace

TEST_CASE("unite walls: all cases, merged or not", "[merge]") {
  for (const NamedCase& c : caseList()) {
    CAPTURE(c.name);
    const CutResult result = cut(c.mesh, c.grid);
    const CellComplex single = complexOf(c.mesh, result.mesh), merged = mergeSmallCells(result.mesh, single).cells;
    for (const CellComplex* cells : {&single, &merged}) {
      for (const double angle : {10.0, 30.0, 90.0})
        requireUnited(c.mesh, result.mesh, *cells, uniteWalls(result.mesh, *cells, WallOptions{{}, angle, {}}));
    }
  }
}

TEST_CASE("unite walls: a cube's sides are one face in each cell, unless their triangles are of two groups", "[merge]") {
  const Mesh cube = shapes::cube(1.25, 2.75);
  const CutResult result = cut(cube, unitGrid(4));
  const CellComplex cells = complexOf(cube, result.mesh);
  // 8 cells inside have three sides each.
  CHECK(wallsOf(cells) > 24);
  const CellComplex united = uniteWalls(result.mesh, cells);
  CHECK(wallsOf(united) == 24);
  for (size_t f = 0; f < united.faceCount(); ++f) {
    if (united.faceTag[f] == FaceTag::surface) CHECK(united.faceArea[f] == 0.75 * 0.75);
  }
  std::vector<uint32_t> groups;
  for (uint32_t t = 0; t < 12; ++t) groups.push_back(t % 2);
  CHECK(wallsOf(uniteWalls(result.mesh, cells, WallOptions{{}, 30, groups})) == wallsOf(cells));
  CHECK(uniteWalls(result.mesh, cells, WallOptions{{}, 30, groups}).fingerprint != united.fingerprint);
}

TEST_CASE("unite walls: as far as the angle allows, and unless a cell would lose much of its volume", "[merge]") {
  const auto countOf = [](const std::vector<std::array<double, 2>>& polygon, double angle) {
    const Mesh mesh = shapes::prism(polygon, 0.25, 0.75);
    const CutResult result = cut(mesh, unitGrid(1));
    return wallsOf(uniteWalls(result.mesh, complexOf(mesh, result.mesh), WallOptions{{}, angle, {}}));
  };
  // The sides of the roof are 23 degrees apart.
  const std::vector<std::array<double, 2>> house{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.6}, {0.5, 0.65}, {0.25, 0.6}};
  CHECK(countOf(house, 20) == 7);
  CHECK(countOf(house, 30) == 6);
  const std::vector<std::array<double, 2>> roof{{0.25, 0.25}, {0.75, 0.25}, {0.5, 0.3}};
  CHECK(countOf(roof, 30) == 5);
}

TEST_CASE("unite walls: a ball, finely triangulated", "[merge]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 5);
  const CutResult result = cut(ball, unitGrid(8));
  const CellComplex merged = mergeSmallCells(result.mesh, complexOf(ball, result.mesh)).cells;
  const CellComplex united = uniteWalls(result.mesh, merged);
  requireUnited(ball, result.mesh, merged, united);
  CHECK(wallsOf(united) < 3 * merged.cutCells);
  CHECK(wallsOf(merged) > 50 * merged.cutCells);
}

TEST_CASE("unite walls: real meshes, coarsened and merged", "[merge]") {
  const auto folder = meshFolder();
  if (!folder) return;
  for (const char* name : {"common_spot", "codim_skirt8K", "assimp_Wuson", "trimesh_chair_model", "manifold_self_intersectA"}) {
    CAPTURE(name);
    const Mesh mesh = readMesh((*folder / (std::string(name) + ".obj.gz")).string());
    const CutResult result = cut(mesh, Grid::around(mesh, 24));
    const CellComplex merged = mergeSmallCells(result.mesh, complexOf(mesh, result.mesh, 3)).cells;
    const CellComplex united = uniteWalls(result.mesh, merged);
    requireUnited(mesh, result.mesh, merged, united);
    CHECK(wallsOf(united) < wallsOf(merged));
  }
}

TEST_CASE("unite walls: wrong options, and cells of others", "[merge]") {
  const Mesh ball = shapes::icosphere({4, 4, 4}, 2.3, 2);
  const CutResult result = cut(ball, unitGrid(8)), other = cut(ball, unitGrid(9));
  const CellComplex cells = complexOf(ball, result.mesh);
  for (const double angle : {-1.0, 91.0, double(NAN)}) {
    CHECK(refusal([&] { uniteWalls(result.mesh, cells, WallOptions{{}, angle, {}}); }).first == Status::badOption);
  }
  const std::vector<uint32_t> tooFew(3);
  CHECK(refusal([&] { uniteWalls(result.mesh, cells, WallOptions{{}, 30, tooFew}); }).first == Status::badArgument);
  CHECK(refusal([&] { uniteWalls(other.mesh, cells); }).first == Status::badArgument);
}

TEST_CASE("merge, unite walls: the same to the bit for any number of threads", "[merge]") {
  const Mesh ball = shapes::icosphere({12, 11, 13}, 6.2, 3);
  const CutResult result = cut(ball, unitGrid(25));
  for (const int maxLevel : {0, 24}) {
    const CellComplex before = complexOf(ball, result.mesh, maxLevel);
    const auto bytesWith = [&](unsigned threads) {
      MergeOptions options;
      options.threads = threads;
      const MergedCells merged = mergeSmallCells(result.mesh, before, options);
      WallOptions walls;
      walls.threads = threads;
      return std::pair(bytesOfFields(merged), bytesOfFields(uniteWalls(result.mesh, merged.cells, walls)));
    };
    const auto one = bytesWith(1);
    CHECK(bytesWith(2) == one);
    CHECK(bytesWith(3) == one);
  }
}

TEST_CASE("merge, unite walls: cancelled at any report", "[merge]") {
  const Mesh ball = shapes::icosphere({12, 11, 13}, 6.2, 2);
  const CutResult result = cut(ball, unitGrid(25));
  const CellComplex before = complexOf(ball, result.mesh, 0);
  const auto isCancelled = [&](auto options, int reports, const auto& call) {
    options.threads = 2;
    options.progress = [&](const Progress&) { return reports-- > 0; };
    try {
      call(options);
    } catch (const CallError& failure) {
      return failure.error.status == Status::cancelled;
    }
    return false;
  };
  for (const int reports : {0, 3, 9}) {
    CAPTURE(reports);
    CHECK(isCancelled(MergeOptions(), reports, [&](const MergeOptions& options) { mergeSmallCells(result.mesh, before, options); }));
    CHECK(isCancelled(WallOptions(), reports, [&](const WallOptions& options) { uniteWalls(result.mesh, before, options); }));
  }
}

TEST_CASE("Merging: large and tiny cells are merged as others are, and those that doubles can't compute on are refused", "[merge]") {
  const auto scaled = [](int exponent) {
    Mesh mesh = shapes::icosphere({0.1, 0.2, 0.3}, 1, 2);
    for (double& x : mesh.positions) x = std::ldexp(x, exponent);
    const double end = std::ldexp(1.5, exponent);
    CutMesh cutMesh = cut(mesh, Grid::box({-end, -end, -end}, {end, end, end}, {6, 6, 6})).mesh;
    CellComplex cells = complexOf(mesh, cutMesh);
    return std::pair(std::move(cutMesh), std::move(cells));
  };
  const auto merged = [&](int exponent) {
    const auto cells = scaled(exponent);
    return mergeSmallCells(cells.first, cells.second);
  };
  const MergedCells plain = merged(0);
  for (const int exponent : {-230, 230}) {
    CAPTURE(exponent);
    const MergedCells other = merged(exponent);
    CHECK(other.mergedCell == plain.mergedCell);
    std::vector<double> centroids = other.cells.cellCentroid;
    for (double& x : centroids) x = std::ldexp(x, -exponent);
    CHECK(centroids == plain.cells.cellCentroid);
  }
  for (const int exponent : {-330, 330}) {
    CAPTURE(exponent);
    const auto cells = scaled(exponent);
    CHECK(refusal([&] { mergeSmallCells(cells.first, cells.second); }).first == Status::badArgument);
    CHECK(refusal([&] { uniteWalls(cells.first, cells.second); }).first == Status::badArgument);
  }
}
