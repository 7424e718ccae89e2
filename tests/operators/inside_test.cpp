// Generalized winding numbers, and the regions that estimates make of open surfaces.
#include "mandoline/inside.h"

#include <cmath>
#include <random>

#include "catch.h"
#include "checked_cut.h"
#include "mandoline/mesh_files.h"
#include "mandoline/slice.h"
#include "mesh_folder.h"
#include "operators/inside/cell_samples.h"
#include "operators/inside/divided_regions.h"
#include "operators/inside/inside_rule.h"
#include "operators/inside/turn_sum.h"
#include "operators/inside/winding_tree.h"
#include "operators/measure/owners.h"
#include "refusal.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;
using Point = std::array<double, 3>;

namespace {

/// The plain sum, with the C library's angles.
double bruteForce(const Mesh& mesh, const Point& p) {
  double sum = 0;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    Point v[3];
    double length[3];
    for (size_t i = 0; i < 3; ++i) {
      for (size_t d = 0; d < 3; ++d) v[i][d] = mesh.positions[3 * size_t(mesh.triangles[3 * t + i]) + d] - p[d];
      length[i] = std::sqrt(v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]);
    }
    const auto dot = [&](int i, int j) { return v[i][0] * v[j][0] + v[i][1] * v[j][1] + v[i][2] * v[j][2]; };
    const double volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) + v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                          v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    if (volume == 0) continue;  // in the triangle's plane: 0, also on it, as the mean of its sides
    sum += std::atan2(volume, length[0] * length[1] * length[2] + dot(0, 1) * length[2] + dot(1, 2) * length[0] + dot(2, 0) * length[1]);
  }
  return sum / (2 * std::acos(-1.0));
}

/// Random points in a box around the mesh, twice its size.
std::vector<double> pointsAround(const Mesh& mesh, size_t count, unsigned seed) {
  Point low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  for (const uint32_t v : mesh.triangles) {
    for (size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], mesh.positions[3 * size_t(v) + d]);
      high[d] = std::max(high[d], mesh.positions[3 * size_t(v) + d]);
    }
  }
  std::mt19937 random(seed);
  std::vector<double> points;
  for (size_t i = 0; i < 3 * count; ++i) {
    const size_t d = i % 3;
    points.push_back(low[d] + (high[d] - low[d]) * (2 * (double(random()) * 0x1p-32) - 0.5));
  }
  return points;
}

void compareWithBruteForce(const Mesh& mesh, size_t count) {
  const std::vector<double> points = pointsAround(mesh, count, 7), found = generalizedWindingNumbers(mesh, points);
  double worst = 0;
  for (size_t i = 0; i < count; ++i) {
    worst = std::max(worst, std::fabs(found[i] - bruteForce(mesh, {points[3 * i], points[3 * i + 1], points[3 * i + 2]})));
  }
  CHECK(worst < 1e-9);
  RunOptions threads;
  threads.threads = 3;
  CHECK(generalizedWindingNumbers(mesh, points, threads) == found);
}

Mesh withoutEvery(Mesh mesh, size_t nth) {
  std::vector<uint32_t> kept;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    for (size_t i = 0; i < 3 && t % nth != 0; ++i) kept.push_back(mesh.triangles[3 * t + i]);
  }
  mesh.triangles = kept;
  return mesh;
}

/// By region, the area of its cells' polygons or of its outlines in a plane.
template <class Cut>
std::vector<double> areasByRegion(const Cut& cut, const Plane& plane, size_t regions) {
  std::vector<double> areas(regions, 0);
  for (size_t p = 0; p < cut.polygonCount(); ++p) {
    for (uint32_t l = cut.polygonLoopOffsets[p]; l < cut.polygonLoopOffsets[p + 1]; ++l) {
      const uint32_t first = cut.loopOffsets[l], past = cut.loopOffsets[l + 1];
      for (uint32_t i = first; i < past; ++i) {
        const double *a = &cut.positions[3 * cut.loopPoints[i]], *b = &cut.positions[3 * cut.loopPoints[i + 1 < past ? i + 1 : first]];
        for (size_t d = 0; d < 3; ++d) {
          const size_t e = (d + 1) % 3, f = (d + 2) % 3;
          areas[cut.polygonRegion[p]] += plane.normal[d] * (a[e] * b[f] - a[f] * b[e]) / 2;
        }
      }
    }
  }
  return areas;
}

/// What must hold of any cut-mesh with estimates.
double checkedEstimate(const Mesh& mesh, const CutMesh& cutMesh, const CutMesh& estimated) {
  for (const Check& check : validate(mesh, estimated).checks) {
    INFO(check.name << ": " << check.message);
    CHECK(check.pass);
  }
  RunOptions threads;
  EstimateOptions options;
  options.threads = 3;
  CHECK(differences(estimateInside(mesh, cutMesh, options), estimated).empty());
  const InsideRegions inside = insideRegions(estimated);
  CHECK(inside.isComplete);
  const Mesh solid = boundary(estimated);
  CHECK(shapes::openEdges(solid) == 0);
  const std::vector<double> volumes = regionVolumes(estimated, measure(mesh, estimated));
  double volume = 0, all = 0;
  for (size_t r = 0; r < volumes.size(); ++r) {
    volume += inside.isInside[r] ? volumes[r] : 0;
    all += volumes[r];
  }
  CHECK(std::fabs(shapes::signedVolume(solid) - volume) < 1e-9 * all);
  std::mt19937 random(3);
  const auto& planes = estimated.grid.planes;
  for (int i = 0; i < 6; ++i) {
    const size_t axis = size_t(i) % 3;
    Plane plane{{0, 0, 0}, 0};
    plane.normal[axis] = 1;
    plane.offset = planes[axis].front() + (planes[axis].back() - planes[axis].front()) * (double(random()) * 0x1p-32);
    if (i >= 3) plane.normal[(axis + 1) % 3] = 0.1;
    const std::vector<double> expected = areasByRegion(slice(estimated, plane), plane, estimated.regionCount);
    const std::vector<double> found = areasByRegion(outlines(estimated, plane), plane, estimated.regionCount);
    double sum = 0, worst = 0;
    for (size_t r = 0; r < found.size(); ++r) {
      sum += expected[r];
      worst = std::max(worst, std::fabs(found[r] - expected[r]));
    }
    CHECK(worst <= 1e-9 * sum);
  }
  return volume;
}

}  // namespace

TEST_CASE("angles in turns are those of atan2", "[inside]") {
  std::mt19937 random(1);
  const auto number = [&] { return std::ldexp(2 * (double(random()) * 0x1p-32) - 1, int(random() % 60) - 30); };
  for (int i = 0; i < 100000; ++i) {
    const double x = number(), y = number();
    CHECK(std::fabs(operators::turnsOf(x, y) - std::atan2(y, x) / (2 * std::acos(-1.0))) < 3e-16);
  }
  CHECK(operators::turnsOf(-1, 0) == 0.5);
  CHECK(operators::turnsOf(0, -1) == -0.25);
}

TEST_CASE("generalized winding numbers are sums of solid angles", "[inside]") {
  using namespace shapes;
  const Mesh sphere = icosphere({1, 2, 3}, 1.5, 4);
  compareWithBruteForce(sphere, 300);
  compareWithBruteForce(withoutEvery(sphere, 7), 300);
  compareWithBruteForce(
      merged({withoutEvery(torus({0, 0, 0}, 2, 0.5, 40, 20), 5), flipped(icosphere({2, 0, 0}, 1, 3)), moebius({0, 0, 1}, 1, 0.5, 50)}),
      300);
  std::mt19937 random(5);
  std::vector<std::array<shapes::Point, 3>> soup(500);
  for (auto& triangle : soup) {
    for (auto& corner : triangle) {
      for (double& x : corner) x = double(random()) * 0x1p-32;
    }
  }
  compareWithBruteForce(shapes::soup(soup), 300);
  compareWithBruteForce(scaled(withoutEvery(sphere, 3), {1e150, 1e150, 1e150}), 30);
  CHECK(generalizedWindingNumbers(sphere, std::vector<double>{1, 2, 3})[0] == Approx(1).epsilon(1e-12));
  CHECK(refusal([&] { generalizedWindingNumbers(sphere, std::vector<double>{1, 2}); }).first == Status::badArgument);
  Mesh bad = sphere;
  bad.triangles[7] = 9999;
  CHECK(refusal([&] { generalizedWindingNumbers(bad, std::vector<double>{1, 2, 3}); }) == std::pair{Status::badIndex, int64_t(2)});
}

TEST_CASE("a point on a triangle gets the mean of its sides", "[inside]") {
  const Mesh cube = shapes::cube(0, 1);
  CHECK(generalizedWindingNumbers(cube, std::vector<double>{0.25, 0.5, 1})[0] == Approx(0.5));
}

TEST_CASE("estimates divide the region of a bowl at its opening", "[inside]") {
  Mesh mesh = shapes::cube(1, 3);
  std::vector<uint32_t> kept;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {  // without its upper side
    bool isLid = true;
    for (size_t i = 0; i < 3; ++i) isLid &= mesh.positions[3 * size_t(mesh.triangles[3 * t + i]) + 2] == 3;
    for (size_t i = 0; i < 3 && !isLid; ++i) kept.push_back(mesh.triangles[3 * t + i]);
  }
  mesh.triangles = kept;
  for (const int64_t cells : {4, 8, 13}) {
    const Grid grid = Grid::box({0, 0, 0}, {4, 4, 4}, {cells, cells, cells});
    const CheckedCut cut = checkedCut(mesh, grid);
    REQUIRE(cut.mesh.regionCount == 1);
    const CutMesh estimated = estimateInside(mesh, cut.mesh);
    CHECK(insideRegions(estimated).by == InsideBy::estimate);
    CHECK(checkedEstimate(mesh, cut.mesh, estimated) == Approx(8).epsilon(0.25));
  }
}

TEST_CASE("a sphere with many holes is nearly that sphere, whichever way it is turned", "[inside]") {
  const Mesh mesh = withoutEvery(shapes::icosphere({2, 2, 2}, 1.6, 3), 9);
  const Grid grid = Grid::box({0, 0, 0}, {4, 4, 4}, {16, 15, 14});
  const double sphere = shapes::signedVolume(shapes::icosphere({2, 2, 2}, 1.6, 3));
  const CheckedCut cut = checkedCut(mesh, grid);
  CHECK(cut.stats.parts.open > 0);
  CHECK(checkedEstimate(mesh, cut.mesh, estimateInside(mesh, cut.mesh)) == Approx(sphere).epsilon(0.02));
  const Mesh turned = shapes::flipped(mesh);
  const CutMesh ofTurned = estimateInside(turned, checkedCut(turned, grid).mesh);
  const std::vector<double> volumes = regionVolumes(ofTurned, measure(turned, ofTurned));
  double positive = 0, nonZero = 0;
  for (size_t r = 0; r < volumes.size(); ++r) {
    positive += insideRegions(ofTurned, {WindingRule::positive}).isInside[r] ? volumes[r] : 0;
    nonZero += insideRegions(ofTurned, {WindingRule::nonZero}).isInside[r] ? volumes[r] : 0;
  }
  CHECK(positive == 0);
  CHECK(nonZero == Approx(sphere).epsilon(0.02));
}

TEST_CASE("closed parts stay exact beside open ones", "[inside]") {
  using namespace shapes;
  const Mesh house = cube(0.5, 1.5), open = withoutEvery(icosphere({3, 3, 3}, 0.8, 2), 11);
  Mesh turned = box({0.5, 2.5, 0.5}, {1.5, 3.5, 1.5});
  std::swap(turned.triangles[0], turned.triangles[1]);
  const Mesh mesh = merged({house, turned, open});
  const CheckedCut cut = checkedCut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {15, 15, 15}));
  const CutMesh estimated = estimateInside(mesh, cut.mesh);
  checkedEstimate(mesh, cut.mesh, estimated);
  const auto at = [&](const std::vector<double>& p) { return insideRegions(estimated).isInside[size_t(cellsAt(estimated, p).region[0])]; };
  CHECK(at({1, 1, 1}) == 1);
  CHECK(at({1, 3, 1}) == 1);
  CHECK(at({3, 3, 3}) == 1);
  CHECK(at({2, 2, 0.25}) == 0);
}

TEST_CASE("a cell without grid-faces gets the side of its triangles", "[inside]") {
  using namespace shapes;
  const Mesh mesh =
      merged({withoutEvery(icosphere({1.5, 1.5, 1.5}, 0.4, 1), 3), icosphere({1.5, 1.5, 1.5}, 0.45, 2), flipped(cube(1.4, 1.6))});
  const CheckedCut cut = checkedCut(mesh, unitGrid(3));
  checkedEstimate(mesh, cut.mesh, estimateInside(mesh, cut.mesh));
}

TEST_CASE("estimates are the same for triangles in any order", "[inside]") {
  const Mesh mesh = withoutEvery(shapes::icosphere({2, 2, 2}, 1.6, 3), 5);
  const Grid grid = unitGrid(4);
  std::vector<uint32_t> newTriangle;
  const Mesh other = shapes::shuffled(mesh, 4, newTriangle);
  const CutMesh a = estimateInside(mesh, checkedCut(mesh, grid).mesh), b = estimateInside(other, checkedCut(other, grid).mesh);
  REQUIRE(a.regionCount == b.regionCount);
  CHECK(a.runBegin == b.runBegin);
  CHECK(a.runRegion == b.runRegion);
  for (uint32_t r = 0; r < a.regionCount; ++r) CHECK(a.regionInsideness[r] == Approx(b.regionInsideness[r]).margin(1e-9));
}

TEST_CASE("between two points of a box generalized winding numbers vary by no more than is said, but for a whole number", "[inside]") {
  const Mesh mesh = withoutEvery(shapes::icosphere({0, 0, 0}, 1, 3), 40);
  std::vector<uint32_t> all(mesh.triangleCount());
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  const operators::WindingTree tree(mesh, all);
  CHECK(tree.rimSize() == shapes::openEdges(mesh));
  std::mt19937 random(9);
  const auto number = [&] { return 2 * (double(random()) * 0x1p-32) - 1; };
  int finite = 0;
  for (int i = 0; i < 3000; ++i) {
    const Point p{1.5 * number(), 1.5 * number(), 1.5 * number()};
    Point q;
    for (size_t d = 0; d < 3; ++d) q[d] = p[d] + 0.1 * number();
    detail::Box box{p, p};
    box.include({q, q});
    const double variation = tree.variation(box), difference = tree.at(p) - tree.at(q);
    CHECK(std::fabs(difference - std::round(difference)) <= variation + 1e-12);
    finite += variation < 1;
  }
  CHECK(finite > 1000);
}

TEST_CASE("how a generalized winding number changes on a way past all triangles is known from the edges that bound them", "[inside]") {
  const Mesh mesh = withoutEvery(shapes::icosphere({0, 0, 0}, 1, 3), 40);
  std::vector<uint32_t> all(mesh.triangleCount());
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  const operators::WindingTree tree(mesh, all);
  std::mt19937 random(11);
  const auto number = [&] { return 2 * (double(random()) * 0x1p-32) - 1; };
  for (int i = 0; i < 1000; ++i) {
    Point p, q;
    for (size_t d = 0; d < 3; ++d) p[d] = 0.55 * number(), q[d] = 0.55 * number();
    CHECK(tree.change(p, q) == Approx(tree.at(q) - tree.at(p)).margin(1e-12));
    CHECK(tree.change(q, p) == Approx(-tree.change(p, q)).margin(1e-12));
    for (size_t d = 0; d < 3; ++d) q[d] *= 4;
    const double change = tree.change(p, q), difference = tree.at(q) - tree.at(p);
    CHECK(change - difference == Approx(std::round(change - difference)).margin(1e-12));
  }
}

TEST_CASE("labels that spread from some cells are those that all have", "[inside]") {
  for (const size_t nth : {60, 500}) {
    const Mesh mesh = withoutEvery(shapes::icosphere({2, 2, 2}, 1.6, 4), nth);
    const CheckedCut cut = checkedCut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {21, 20, 19}));
    REQUIRE(cut.mesh.regionCount == 1);
    const OctreeCells octree = coarsen(cut.mesh);
    const std::vector<int32_t> owners = operators::ownersOf(cut.mesh);
    const operators::WindingTree tree(mesh, cut.mesh.openTriangles);
    REQUIRE(16 * tree.rimSize() < mesh.triangleCount());
    const std::vector<uint8_t> isOpen(mesh.triangleCount(), 1);
    operators::CellSampler sampler(cut.mesh, isOpen);
    std::vector<int32_t> labels;
    for (uint32_t c = 0; c < cut.mesh.cellCount(); ++c) {
      const operators::CellSample sample = sampler.sample(c);
      labels.push_back(operators::roundedWinding(sample.step + tree.at(sample.point, sample.leftOut), 0.5));
    }
    for (size_t c = 0; c < octree.cellCount(); ++c) {
      Point centre;
      for (size_t d = 0; d < 3; ++d) {
        const std::vector<double>& planes = cut.mesh.grid.planes[d];
        centre[d] = planes[size_t(octree.corner(c)[d])] / 2 + planes[size_t(octree.end(c)[d])] / 2;
      }
      labels.push_back(operators::roundedWinding(tree.at(centre), 0.5));
    }
    const operators::DividedRegions expected = operators::divideRegions(cut.mesh, octree, owners, labels);
    const CutMesh estimated = estimateInside(mesh, cut.mesh);
    CHECK(estimated.regionCount == expected.count);
    CHECK(estimated.cellRegion == expected.cellRegion);
    CHECK(estimated.runRegion == expected.runRegion);
  }
}

TEST_CASE("estimates are cancelled while labels spread", "[inside]") {
  const Mesh mesh = withoutEvery(shapes::icosphere({2, 2, 2}, 1.6, 4), 60);
  const CutMesh cutMesh = checkedCut(mesh, Grid::box({0, 0, 0}, {4, 4, 4}, {21, 20, 19})).mesh;
  EstimateOptions options;
  options.progress = [](const Progress& progress) { return progress.stageIndex != 3 || progress.done == 0; };
  CHECK(refusal([&] { estimateInside(mesh, cutMesh, options); }).first == Status::cancelled);
}

TEST_CASE("wrong calls of estimateInside are refused, and without open parts it changes nothing", "[inside]") {
  const Mesh cube = shapes::cube(0.5, 2.5), open = withoutEvery(cube, 12);
  const CutMesh closed = checkedCut(cube, unitGrid(3)).mesh, cutOpen = checkedCut(open, unitGrid(3)).mesh;
  CHECK(differences(estimateInside(cube, closed), closed).empty());
  const CutMesh estimated = estimateInside(open, cutOpen);
  EstimateOptions options;
  options.threshold = 0;
  CHECK(refusal([&] { estimateInside(open, cutOpen, options); }).first == Status::badOption);
  CHECK(refusal([&] { estimateInside(open, estimated); }).first == Status::badArgument);
  CHECK(refusal([&] { estimateInside(cube, cutOpen); }).first == Status::badArgument);
  CHECK(refusal([&] { boundary(closed, std::vector<uint8_t>(7)); }).first == Status::badArgument);
}

TEST_CASE("damaged estimates are caught", "[inside]") {
  const Mesh mesh = withoutEvery(shapes::icosphere({2, 2, 2}, 1.6, 3), 9);
  const CutMesh estimated = estimateInside(mesh, checkedCut(mesh, unitGrid(8)).mesh);
  REQUIRE(estimated.regionCount > 1);
  const auto fails = [&](const std::function<void(CutMesh&)>& damage) {
    CutMesh damaged = estimated;
    damage(damaged);
    return !validate(mesh, damaged).pass;
  };
  CHECK(fails([](CutMesh& c) { c.regionInsideness.clear(); }));
  CHECK(fails([](CutMesh& c) { c.regionInsideness[0] = NAN; }));
  CHECK(fails([](CutMesh& c) { c.regionInsideness.pop_back(); }));
  CHECK(fails([](CutMesh& c) { c.regionInsideness[1] = c.regionInsideness[0]; }));
  CHECK(fails([](CutMesh& c) { c.runRegion.front() = (c.runRegion.front() + 1) % c.regionCount; }));
  CHECK(fails([](CutMesh& c) { c.openTriangles[1] = c.openTriangles[0]; }));
  CHECK(fails([](CutMesh& c) { c.regionParity.assign(c.regionCount, 2); }));
}

TEST_CASE("real open scans: closed boundaries and outlines", "[scans]") {
  const std::optional<std::filesystem::path> folder = meshFolder();
  if (!folder) return;
  size_t scans = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (scans == 10 || entry.path().extension() != ".gz") continue;
    const Mesh mesh = readMesh(entry.path().string());
    if (mesh.triangleCount() > 30000 || mesh.triangleCount() < 1000) continue;
    const CutResult cut = mandoline::cut(mesh, Grid::around(mesh, 20));
    if (!cut || cut.stats.parts.open == 0 || cut.stats.parts.winding > 0) continue;
    ++scans;
    INFO(entry.path().filename().string());
    checkedEstimate(mesh, cut.mesh, estimateInside(mesh, cut.mesh));
    compareWithBruteForce(mesh, 20);
  }
  CHECK(scans == 10);
}
