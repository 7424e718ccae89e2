// Results know what they were made of: equal input gives equal fingerprints, and what was not made from each other is refused.
#include <algorithm>
#include <limits>
#include <set>

#include "catch.h"
#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

const Grid kGrid = Grid::box({0, 0, 0}, {4, 4, 4}, {4, 4, 4});

CutMesh cutOf(const Mesh& mesh, const Grid& grid = kGrid, double snapTolerance = 0, Intersections intersections = Intersections::resolve) {
  CutOptions options;
  options.snapTolerance = snapTolerance;
  options.intersections = intersections;
  const CutResult result = cut(mesh, grid, options);
  REQUIRE(result);
  return result.mesh;
}

Mesh ball() { return shapes::icosphere({2.1, 1.9, 2}, 1.3, 2); }

/// The message of the CallError with the status badArgument; empty if there is none.
template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const CallError& error) {
    CHECK(error.error.status == Status::badArgument);
    return error.error.message;
  }
  return "";
}

}  // namespace

TEST_CASE("fingerprints: equal input has equal ones", "[fingerprints]") {
  const Mesh mesh = ball();
  const CutMesh one = cutOf(mesh);
  CHECK(one.fingerprint.isKnown());
  CHECK(one.madeFrom.isKnown());
  const auto requireAlike = [&](const CutMesh& other) {
    CHECK(other.madeFrom == one.madeFrom);
    CHECK(other.fingerprint == one.fingerprint);
  };
  for (const unsigned threads : {1u, 3u}) {
    CutOptions options;
    options.threads = threads;
    requireAlike(cut(mesh, kGrid, options).mesh);
    requireAlike(cut(prepare(mesh).mesh, kGrid, options).mesh);
  }
  requireAlike(cutOf(mesh, Grid::rectilinear(kGrid.planes)));
}

TEST_CASE("fingerprints: those of a cube never change", "[fingerprints]") {
  const Mesh cube{{1, 1, 1, 3, 1, 1, 1, 3, 1, 3, 3, 1, 1, 1, 3, 3, 1, 3, 1, 3, 3, 3, 3, 3},
                  {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5}};
  const CutMesh cutMesh = cutOf(cube);
  CHECK(cutMesh.madeFrom.text() == "9a23d64f6d8a4243");
  CHECK(cutMesh.fingerprint.text() == "26cc5998a0e07d44");
}

TEST_CASE("fingerprints: other numbers, planes and options have others", "[fingerprints]") {
  const Mesh mesh = ball();
  std::vector<CutMesh> all{cutOf(mesh), cutOf(mesh, kGrid, 1e-9), cutOf(mesh, kGrid, 0, Intersections::assumeNone)};
  Mesh other = mesh;
  other.positions[100] = std::nextafter(other.positions[100], 9);
  all.push_back(cutOf(other));
  other = mesh;
  std::swap_ranges(&other.triangles[0], &other.triangles[3], &other.triangles[3]);
  all.push_back(cutOf(other));
  other = mesh;
  std::rotate(&other.triangles[0], &other.triangles[1], &other.triangles[3]);
  all.push_back(cutOf(other));
  other = mesh;
  other.positions.insert(other.positions.end(), {0, 0, 0});
  all.push_back(cutOf(other));
  Grid graded = kGrid;
  graded.planes[1][2] = std::nextafter(2, 3);
  all.push_back(cutOf(mesh, Grid::rectilinear(graded.planes)));
  std::set<uint64_t> cuts, inputs;
  for (const CutMesh& cutMesh : all) cuts.insert(cutMesh.fingerprint.value), inputs.insert(cutMesh.madeFrom.value);
  CHECK(cuts.size() == all.size());
  CHECK(inputs.size() == 5);
}

TEST_CASE("fingerprints: what files change of a number does not matter", "[fingerprints]") {
  Mesh one = shapes::cube(0, 3), other = one;
  for (double& x : other.positions) x = x == 0 ? -0.0 : x;
  CHECK(cutOf(one).madeFrom == cutOf(other).madeFrom);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  one.positions.insert(one.positions.end(), {nan, nan, nan});  // which no triangle has
  other.positions.insert(other.positions.end(), {-nan, nan, nan});
  CHECK(cutOf(one).madeFrom == cutOf(other).madeFrom);
}

TEST_CASE("fingerprints: what was not made from the cut-mesh is refused", "[fingerprints]") {
  // With the same arrays but for positions.
  const Mesh mesh = ball(), moved = shapes::translated(mesh, {8, 0, 0});
  const CutMesh here = cutOf(mesh), there = cutOf(moved, Grid::box({8, 0, 0}, {12, 4, 4}, {4, 4, 4}));
  REQUIRE(here.loopVertices == there.loopVertices);
  const Measures measures = measure(moved, there);
  CHECK(complaint([&] { measure(moved, here); }).starts_with("The mesh is not the one"));
  CHECK(complaint([&] { regionVolumes(here, measures); }) == "The measures are those of another cut-mesh.");
  CHECK(complaint([&] { cellComplex(mesh, here, coarsen(there)); }) == "The octree cells are not those of this cut-mesh.");
  const CellComplex cells = cellComplex(moved, there, coarsen(there));
  CHECK(complaint([&] { writeVtu([](std::string_view) {}, here, cells); }) == "The cells are not all of this cut-mesh's.");
  CHECK(triangulateFaces(here).madeFrom == here.fingerprint);
  CHECK_FALSE(triangulateFaces(there).madeFrom == here.fingerprint);
}

TEST_CASE("fingerprints: a part of the cells, and estimates, are results of their own", "[fingerprints]") {
  const Mesh mesh = ball();
  const CutMesh cutMesh = cutOf(mesh);
  CoarsenOptions single;
  single.maxLevel = 0;
  const CellComplex cells = cellComplex(mesh, cutMesh, coarsen(cutMesh)), fine = cellComplex(mesh, cutMesh, coarsen(cutMesh, single));
  CHECK(cells.madeFrom == cutMesh.fingerprint);
  CHECK_FALSE(cells.fingerprint == fine.fingerprint);
  const CellComplex inner = regionComplex(cells, 0).cells, outer = regionComplex(cells, 1).cells;
  CHECK(inner.madeFrom == cells.fingerprint);
  CHECK_FALSE(inner.fingerprint == outer.fingerprint);
  CHECK(estimateInside(mesh, cutMesh).fingerprint == cutMesh.fingerprint);
  const Mesh open = shapes::moebius({2, 2, 2}, 1, 0.6, 24);
  const CutMesh sheet = cutOf(open), estimated = estimateInside(open, sheet);
  CHECK(estimated.madeFrom == sheet.madeFrom);
  CHECK_FALSE(estimated.fingerprint == sheet.fingerprint);
}

TEST_CASE("fingerprints: arrays from elsewhere have none, and are trusted to belong together", "[fingerprints]") {
  const Mesh mesh = ball();
  CutMesh cutMesh = cutOf(mesh);
  cutMesh.madeFrom = cutMesh.fingerprint = {};
  Mesh moved = mesh;
  moved.positions[4] += 1e-9;
  CHECK_NOTHROW(regionVolumes(cutMesh, measure(moved, cutMesh)));
  const Mesh other = shapes::cube(1, 2);
  CHECK(complaint([&] { measure(other, cutMesh); }).starts_with("The mesh is not the one"));
  OctreeCells octree = coarsen(cutMesh);
  const CellComplex cells = cellComplex(mesh, cutMesh, octree);
  CHECK_FALSE(cells.fingerprint.isKnown());
  CHECK_FALSE(regionComplex(cells, 0).cells.fingerprint.isKnown());
  octree.cellRegion[3] = cutMesh.regionCount;
  CHECK(complaint([&] { cellComplex(mesh, cutMesh, octree); }) == "The octree cells are not those of this cut-mesh.");
}
