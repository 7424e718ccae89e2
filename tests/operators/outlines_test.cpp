// Outlines of regions in a plane: they enclose what the region's polygons cover, with no seam left and no corner too many.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "catch.h"
#include "checked_cut.h"
#include "mandoline/slice.h"
#include "refusal.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;
using namespace vectors;

namespace {

using Point = shapes::Point;

/// Lengths of the straight pieces of a loop, or of a polyline, which is not closed.
double lengthOf(const std::vector<double>& positions, std::span<const uint32_t> points, bool closed) {
  double sum = 0;
  for (size_t i = closed ? 0 : 1; i < points.size(); ++i)
    sum += length(pointAt(positions, points[i]) - pointAt(positions, points[i > 0 ? i - 1 : points.size() - 1]));
  return sum;
}

/// Where a plane cuts a mesh within the grid, triangle by triangle.
struct Section {
  double length = 0;
  size_t triangles = 0;
};
Section sectionOf(const Mesh& mesh, const Plane& plane, const Grid& grid) {
  Section section;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::vector<Point> ends;
    Point corner[3];
    for (int i = 0; i < 3; ++i) corner[i] = pointAt(mesh.positions, mesh.triangles[3 * t + size_t(i)]);
    for (int i = 0; i < 3; ++i) {
      const Point &a = corner[i], &b = corner[(i + 1) % 3];
      const double ha = dot(plane.normal, a) - plane.offset, hb = dot(plane.normal, b) - plane.offset;
      if ((ha >= 0) == (hb >= 0)) continue;
      ends.push_back({});
      for (size_t d = 0; d < 3; ++d) ends.back()[d] = a[d] + ha / (ha - hb) * (b[d] - a[d]);
    }
    if (ends.empty()) continue;
    double from = 0, to = 1;  // the part of it in the box
    for (size_t d = 0; d < 3; ++d) {
      const double a = ends[0][d], b = ends[1][d], low = grid.planes[d].front(), high = grid.planes[d].back();
      if (a != b) {
        from = std::max(from, std::min((low - a) / (b - a), (high - a) / (b - a)));
        to = std::min(to, std::max((low - a) / (b - a), (high - a) / (b - a)));
      } else if (a < low || a > high) {
        to = 0;
      }
    }
    if (from >= to) continue;
    section.length += (to - from) * length(ends[1] - ends[0]);
    ++section.triangles;
  }
  return section;
}

/// Perimeter of a plane's cut through the grid's box, as an empty grid has it.
double boxPerimeter(const Grid& grid, const Plane& plane) {
  const Point corner = {grid.planes[0].front(), grid.planes[1].front(), grid.planes[2].front()};
  Point tip = corner;
  for (size_t d = 0; d < 3; ++d) tip[d] += 1e-3 * (grid.planes[d][1] - grid.planes[d][0]);
  double sum = 0;
  for (int side = 0; side < 6; ++side) {
    Point normal = {};
    const size_t d = size_t(side / 2);
    normal[d] = 1;
    const double x = side % 2 == 0 ? grid.planes[d].front() : grid.planes[d].back();
    Mesh square;  // the side, as two triangles
    for (int c = 0; c < 4; ++c) {
      Point p;
      p[d] = x;
      for (size_t e = 1; e < 3; ++e) {
        const size_t axis = (d + e) % 3;
        p[axis] = ((c + (e == 1 ? 1 : 0)) / 2) % 2 == 0 ? grid.planes[axis].front() : grid.planes[axis].back();
      }
      square.positions.insert(square.positions.end(), p.begin(), p.end());
    }
    square.triangles = {0, 1, 2, 0, 2, 3};
    sum += sectionOf(square, plane, grid).length;
  }
  return sum;
}

/// What holds for any plane that goes through no vertex.
Outlines checkedOutlines(const Mesh& mesh, const CutMesh& cut, const Plane& plane) {
  INFO("plane " << plane.normal[0] << " " << plane.normal[1] << " " << plane.normal[2] << " = " << plane.offset);
  const Outlines found = outlines(cut, plane);
  const double scale = length(plane.normal);
  bool onPlane = true, sharp = true;
  for (uint32_t p = 0; p < found.positions.size() / 3; ++p)
    onPlane &= std::fabs(dot(plane.normal, pointAt(found.positions, p)) - plane.offset) / scale < 1e-12;
  CHECK(onPlane);
  std::vector<double> areas(cut.regionCount, 0), expected = areas;
  double total = 0;
  for (size_t p = 0; p < found.polygonCount(); ++p) {
    for (uint32_t l = found.polygonLoopOffsets[p]; l < found.polygonLoopOffsets[p + 1]; ++l) {
      const auto loop = itemsOf(found.loopOffsets, found.loopPoints, l);
      REQUIRE(loop.size() >= 3);
      const double area = areaAbout(plane.normal, found.positions, loop);
      CHECK((l == found.polygonLoopOffsets[p] ? area > -1e-12 : area < 1e-12));
      areas[found.polygonRegion[p]] += area;
      total += lengthOf(found.positions, loop, true);
      for (size_t i = 0; i < loop.size(); ++i) sharp &= loop[i] != loop[(i + 1) % loop.size()];
    }
  }
  for (size_t s = 0; s < found.slitCount(); ++s)
    total += 2 * lengthOf(found.positions, itemsOf(found.slitOffsets, found.slitPoints, s), false);
  CHECK(sharp);
  const Slice polygons = slice(cut, plane);
  for (size_t p = 0; p < polygons.polygonCount(); ++p) {
    for (uint32_t l = polygons.polygonLoopOffsets[p]; l < polygons.polygonLoopOffsets[p + 1]; ++l)
      expected[polygons.polygonRegion[p]] +=
          areaAbout(plane.normal, polygons.positions, itemsOf(polygons.loopOffsets, polygons.loopPoints, l));
  }
  for (size_t r = 0; r < areas.size(); ++r) CHECK(areas[r] == Approx(expected[r]).margin(1e-10));
  CHECK(total == Approx(2 * sectionOf(mesh, plane, cut.grid).length + boxPerimeter(cut.grid, plane)).epsilon(1e-10));
  CHECK(std::is_sorted(found.polygonRegion.begin(), found.polygonRegion.end()));
  CHECK(std::is_sorted(found.slitRegion.begin(), found.slitRegion.end()));
  std::set<uint32_t> used(found.loopPoints.begin(), found.loopPoints.end());
  used.insert(found.slitPoints.begin(), found.slitPoints.end());
  CHECK(used.size() == found.positions.size() / 3);
  return found;
}

/// Numbers of points of a region's loops, as they come.
std::vector<size_t> loopSizes(const Outlines& outlines, uint32_t region) {
  std::vector<size_t> sizes;
  for (size_t p = 0; p < outlines.polygonCount(); ++p) {
    for (uint32_t l = outlines.polygonLoopOffsets[p]; l < outlines.polygonLoopOffsets[p + 1] && outlines.polygonRegion[p] == region; ++l)
      sizes.push_back(itemsOf(outlines.loopOffsets, outlines.loopPoints, l).size());
  }
  return sizes;
}

uint32_t regionWithWinding(const CutMesh& mesh, int32_t winding) {
  return uint32_t(std::find(mesh.regionWinding.begin(), mesh.regionWinding.end(), winding) - mesh.regionWinding.begin());
}

Plane randomPlane(std::mt19937& random, const Point& centre) {
  const auto number = [&] { return 2 * (double(random()) * 0x1p-32) - 1; };
  const Point normal = {number(), number(), number()};
  return {normal, dot(normal, centre) + 1.5 * number() * length(normal)};
}

using Sizes = std::vector<size_t>;

}  // namespace

TEST_CASE("a box's outline has its four corners, and two more where the diagonals of its sides are cut", "[outlines]") {
  const Mesh mesh = shapes::cube(0.75, 3.25);
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  const Outlines found = checkedOutlines(mesh, cut.mesh, {{0, 0, 1}, 1.7});
  const uint32_t inside = regionWithWinding(cut.mesh, 1), outside = 1 - inside;
  CHECK(loopSizes(found, inside) == Sizes{8});  // four edges and four diagonals
  CHECK(loopSizes(found, outside) == Sizes{4, 8});
  CHECK(found.slitCount() == 0);
  CHECK(areaAbout({0, 0, 1}, found.positions, itemsOf(found.loopOffsets, found.loopPoints, inside == 0 ? 0 : 2)) == Approx(6.25));
}

TEST_CASE("outlines of a sphere have one point per edge that is cut, however fine the grid", "[outlines]") {
  const Mesh mesh = shapes::icosphere({2, 2, 2}, 1.3, 3);
  for (const int64_t cells : {1, 3, 16}) {
    const CutResult cut = mandoline::cut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {cells, cells, cells}));
    REQUIRE(cut);
    const Plane plane = {{0.1, 0.2, 1}, 2.7};
    const Outlines found = checkedOutlines(mesh, cut.mesh, plane);
    const size_t edges = sectionOf(mesh, plane, cut.mesh.grid).triangles;  // as many, all around
    const uint32_t inside = regionWithWinding(cut.mesh, 1);
    CHECK(loopSizes(found, inside) == Sizes{edges});
    CHECK(loopSizes(found, 1 - inside) == Sizes{4, edges});
    CHECK(found.positions.size() == 3 * (edges + 4));
  }
}

TEST_CASE("outlines of a torus: a ring, and two discs", "[outlines]") {
  const Mesh mesh = shapes::torus({2, 2, 2}, 1, 0.4, 24, 12);
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  const uint32_t inside = regionWithWinding(cut.mesh, 1);
  const Outlines ring = checkedOutlines(mesh, cut.mesh, {{0, 0, 1}, 2.1});
  REQUIRE(ring.polygonCount() == 3);
  CHECK(loopSizes(ring, inside).size() == 2);      // the ring and its hole
  CHECK(loopSizes(ring, 1 - inside).size() == 3);  // the box with the ring as a hole, and what is in the ring's hole
  const Outlines discs = checkedOutlines(mesh, cut.mesh, {{1, 0, 0}, 2.1});
  REQUIRE(discs.polygonCount() == 3);
  CHECK(loopSizes(discs, inside).size() == 2);
  CHECK(loopSizes(discs, 1 - inside).size() == 3);
}

TEST_CASE("outlines of spheres in spheres are rings", "[outlines]") {
  using namespace shapes;
  const Mesh mesh = merged({icosphere({2, 2, 2}, 1.6, 2), flipped(icosphere({2, 2, 2}, 1.2, 2)), icosphere({2, 2, 2}, 0.8, 2)});
  const CheckedCut cut = checkedCut(mesh, unitGrid(5));
  REQUIRE(cut.mesh.regionCount == 4);
  const Outlines found = checkedOutlines(mesh, cut.mesh, {{0.3, 0.2, 1}, 3.1});
  REQUIRE(found.polygonCount() == 4);
  Sizes loops;
  for (size_t p = 0; p < 4; ++p) loops.push_back(found.polygonLoopOffsets[p + 1] - found.polygonLoopOffsets[p]);
  std::sort(loops.begin(), loops.end());
  CHECK(loops == Sizes{1, 2, 2, 2});
}

TEST_CASE("an open sheet is a slit in the outlines, from end to end", "[outlines]") {
  const Mesh mesh = shapes::quad({0.5, 1.5, 0.5}, {3.5, 1.5, 0.5}, {3.5, 2.25, 3.5}, {0.5, 2.25, 3.5});
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  REQUIRE(cut.mesh.regionCount == 1);
  const Outlines found = checkedOutlines(mesh, cut.mesh, {{0, 0, 1}, 1.5});
  CHECK(loopSizes(found, 0) == Sizes{4});
  REQUIRE(found.slitCount() == 1);
  REQUIRE(found.slitPoints.size() == 3);  // its ends, and the diagonal
  // The normal of the sheet, which points to -y, is to the right.
  CHECK(pointAt(found.positions, found.slitPoints[0])[0] == 0.5);
  CHECK(pointAt(found.positions, found.slitPoints[2])[0] == 3.5);
}

TEST_CASE("a mesh with a hole in it is a closed slit where the plane misses the hole", "[outlines]") {
  const Mesh mesh = shapes::tube({2, 2, 0.5}, 1.2, 3, 9, false);
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  REQUIRE(cut.mesh.regionCount == 1);
  const Outlines found = checkedOutlines(mesh, cut.mesh, {{0, 0, 1}, 1.7});
  REQUIRE(found.slitCount() == 1);
  CHECK(found.slitPoints.size() == 19);  // nine edges and nine diagonals, and the first again
  CHECK(found.slitPoints.front() == found.slitPoints.back());
  CHECK(areaAbout({0, 0, 1}, found.positions, found.slitPoints) > 0);  // the normals point outward
}

TEST_CASE("sheets that meet in an edge are as many slits", "[outlines]") {
  const Mesh mesh = shapes::fan({2.2, 2.3, 0.5}, 3, {{1, 0.1}, {-0.3, 1}, {-0.5, -1}});
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  const Outlines found = checkedOutlines(mesh, cut.mesh, {{0, 0, 1}, 1.6});
  CHECK(found.slitCount() == 3);
}

TEST_CASE("a sheet from side to side divides the outlines, which end at the box", "[outlines]") {
  const Mesh mesh = shapes::quad({-1, 1.6, -1}, {5, 1.7, -1}, {5, 2.3, 5}, {-1, 2.2, 5});
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  REQUIRE(cut.mesh.regionCount == 2);
  const Outlines found = checkedOutlines(mesh, cut.mesh, {{0, 0, 1}, 1.5});
  CHECK(loopSizes(found, 0) == Sizes{5});  // two corners of the box, two where the sheet meets it, and the sheet's diagonal
  CHECK(loopSizes(found, 1) == Sizes{5});
  CHECK(found.slitCount() == 0);
  CHECK(found.positions.size() == 3 * 7);
}

TEST_CASE("outlines of a mesh that reaches out of the box end at its sides", "[outlines]") {
  using namespace shapes;
  const Mesh mesh = merged({icosphere({0, 0, 0}, 1.7, 2), icosphere({4, 2, 2}, 1.3, 2), box({1.25, 3.25, 3.25}, {2.25, 5, 5})});
  const CutResult cut = mandoline::cut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {5, 3, 4}));
  REQUIRE(cut);
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) checkedOutlines(mesh, cut.mesh, randomPlane(random, {2, 2, 2}));
}

TEST_CASE("outlines of random planes", "[outlines]") {
  using namespace shapes;
  const Mesh closed = merged({icosphere({1.3, 1.2, 1.4}, 0.9, 2), flipped(icosphere({1.3, 1.2, 1.4}, 0.5, 1)),
                              torus({3.05, 3.05, 2.7}, 0.7, 0.2, 12, 6), octahedron({2.5, 2.5, 0.5}, 0.25), cube(3.25, 3.75)});
  const Mesh open =
      merged({fan({0.7, 3.3, 0.4}, 2.5, {{0.3, 0.2}, {-0.3, 0.2}, {0, -0.4}}), moebius({3.2, 1, 3.3}, 0.4, 0.3, 12),
              quad({2.2, 3.2, 0.3}, {2.8, 3.2, 0.3}, {2.8, 3.8, 0.4}, {2.2, 3.8, 0.4}), tube({1.5, 1.4, 0.3}, 0.6, 1.2, 9, false)});
  std::mt19937 random(3);
  for (const Mesh& mesh : {closed, open}) {
    for (const auto& cells : std::vector<std::array<int64_t, 3>>{{4, 4, 4}, {1, 1, 1}, {3, 7, 5}, {13, 11, 16}}) {
      const CutResult cut = mandoline::cut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, cells));
      REQUIRE(cut);
      for (int i = 0; i < 20; ++i) checkedOutlines(mesh, cut.mesh, randomPlane(random, {2, 2, 2}));
    }
  }
}

TEST_CASE("outlines in planes of the grid, through faces of the surface and along the border", "[outlines]") {
  using namespace shapes;
  const Mesh mesh = merged({cube(1, 2), box({2.5, 2.5, 0}, {4, 4, 4}), octahedron({1.5, 3, 2}, 0.5)});
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  for (size_t d = 0; d < 3; ++d) {
    for (int quarter = 0; quarter <= 16; ++quarter) {
      Plane plane = {{0, 0, 0}, quarter / 4.};
      plane.normal[d] = 1;
      const Outlines found = outlines(cut.mesh, plane);
      double total = 0;
      for (size_t l = 0; l + 1 < found.loopOffsets.size(); ++l)
        total += areaAbout(plane.normal, found.positions, itemsOf(found.loopOffsets, found.loopPoints, l));
      CHECK(total == Approx(16).epsilon(1e-12));
    }
  }
}

TEST_CASE("outlines of boxes that touch in an edge do not cross there", "[outlines]") {
  using namespace shapes;
  const Mesh mesh = merged({box({1, 1, 0.5}, {2, 2, 3.5}), box({2, 2, 0.5}, {3, 3, 3.5})});
  const CutResult cut = mandoline::cut(mesh, unitGrid(4));
  REQUIRE(cut);
  const Outlines found = outlines(cut.mesh, {{0, 0, 1}, 1.5});
  REQUIRE(cut.mesh.regionCount == 3);
  for (uint32_t r = 0; r < 3; ++r) {
    const bool inside = cut.mesh.regionWinding[r] == 1;
    CHECK(loopSizes(found, r) == (inside ? Sizes{8} : Sizes{4, 16}));  // one hole goes around both, twice through the edge they share
  }
  double area = 0;
  for (size_t l = 0; l + 1 < found.loopOffsets.size(); ++l)
    area += areaAbout({0, 0, 1}, found.positions, itemsOf(found.loopOffsets, found.loopPoints, l));
  CHECK(area == Approx(16));
}

TEST_CASE("outlines of parallel planes are those of single calls; wrong ones are refused", "[outlines]") {
  const Mesh mesh = shapes::torus({2, 2, 2}, 1, 0.4, 24, 12);
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  const std::vector<double> offsets = {2.9, -7, 1.1, 2, 2.3, 1.1};
  const std::vector<Outlines> all = outlines(cut.mesh, {0, 0.5, 1}, offsets);
  REQUIRE(all.size() == offsets.size());
  for (size_t i = 0; i < offsets.size(); ++i) {
    const Outlines one = outlines(cut.mesh, {{0, 0.5, 1}, offsets[i]});
    CHECK(all[i].positions == one.positions);
    CHECK(all[i].loopPoints == one.loopPoints);
    CHECK(all[i].polygonLoopOffsets == one.polygonLoopOffsets);
  }
  CHECK(all[1].polygonCount() == 0);
  CHECK(all[1].loopOffsets == std::vector<uint32_t>{0});
  CHECK(refusal([&] { outlines(cut.mesh, {{0, 0, 0}, 1}); }) == std::pair(Status::badArgument, int64_t(-1)));
  CHECK(refusal([&] { outlines(cut.mesh, {{0, 0, 1}, INFINITY}); }) == std::pair(Status::badArgument, int64_t(0)));
  CHECK(refusal([] { outlines(CutMesh(), {{0, 0, 1}, 0}); }).first == Status::badArgument);
}

TEST_CASE("axes of a plane are unit vectors at right angles, and the grid's where they can be", "[outlines]") {
  CHECK(planeAxes({0, 0, 7}).right == Point{1, 0, 0});
  CHECK(planeAxes({0, 0, 7}).up == Point{0, 1, 0});
  CHECK(planeAxes({0, 0, -1}).right == Point{0, 1, 0});
  CHECK(planeAxes({0, 0, -1}).up == Point{1, 0, 0});
  CHECK(planeAxes({5e-324, 0, 0}).right == Point{0, 1, 0});
  for (const Point& normal : std::vector<Point>{{1, 2, 3}, {-1, 0.1, 0.2}, {1e300, -1e300, 1e-300}, {0, 1, -1}}) {
    const PlaneAxes axes = planeAxes(normal);
    Point unit = normal;
    for (double& x : unit) x /= 1e300;
    if (std::fabs(normal[0]) < 1e299) unit = normal;
    CHECK(length(axes.right) == Approx(1));
    CHECK(length(axes.up) == Approx(1));
    CHECK(dot(axes.right, axes.up) == Approx(0).margin(1e-15));
    CHECK(dot(cross(axes.right, axes.up), unit) == Approx(length(unit)));
  }
  CHECK(refusal([] { planeAxes({0, 0, 0}); }).first == Status::badArgument);
  CHECK(refusal([] { planeAxes({0, NAN, 0}); }) == std::pair(Status::badArgument, int64_t(1)));
}
