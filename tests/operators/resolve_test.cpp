// resolve(), whose triangles cover those of the input and know what they are part of, and boundary(), the closed surface of the solid.
#include "mandoline/resolve.h"

#include <algorithm>

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;
using namespace shapes;
using vectors::pointAt;
using vectors::operator-;

namespace {

constexpr WindingRule kRules[] = {WindingRule::positive, WindingRule::nonZero, WindingRule::odd};

bool isInside(int winding, WindingRule rule) {
  return rule == WindingRule::positive ? winding > 0 : rule == WindingRule::nonZero ? winding != 0 : winding % 2 != 0;
}

/// Every edge has an even number of triangles, as many in one direction as in the other, and every vertex has triangles.
void requireClosed(const Mesh& mesh) {
  std::vector<bool> isUsed(mesh.vertexCount());
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const uint32_t a = mesh.triangles[i], b = mesh.triangles[i % 3 < 2 ? i + 1 : i - 2];
    REQUIRE(a != b);
    isUsed.at(a) = true;
  }
  REQUIRE(openEdges(mesh) == 0);
  REQUIRE(std::find(isUsed.begin(), isUsed.end(), false) == isUsed.end());
}

/// The area of a triangle of `mesh` about the normal of a triangle of `input`.
double areaAlong(const Mesh& input, uint32_t parent, const Mesh& mesh, size_t t) {
  const auto corner = [](const Mesh& of, size_t i) { return pointAt(of.positions, of.triangles[i]); };
  const Point a = corner(input, 3 * size_t(parent));
  const Point normal = vectors::cross(corner(input, 3 * size_t(parent) + 1) - a, corner(input, 3 * size_t(parent) + 2) - a);
  return vectors::areaAbout(normal, corner(mesh, 3 * t), corner(mesh, 3 * t + 1), corner(mesh, 3 * t + 2));
}

/// The pieces of each triangle cover its area once, with its normal where their signs say so.
void requireCovered(const Mesh& input, const ResolvedMesh& resolved) {
  std::vector<double> areas(input.triangleCount());
  for (size_t t = 0; t < resolved.mesh.triangleCount(); ++t) {
    REQUIRE(resolved.parentOffsets[t] < resolved.parentOffsets[t + 1]);
    for (uint32_t i = resolved.parentOffsets[t]; i < resolved.parentOffsets[t + 1]; ++i) {
      const double piece = resolved.parentSigns[i] * areaAlong(input, resolved.parents[i], resolved.mesh, t);
      CHECK(piece > 0);
      areas[resolved.parents[i]] += piece;
    }
    REQUIRE(resolved.parentSigns[resolved.parentOffsets[t]] == 1);
  }
  for (uint32_t t = 0; t < input.triangleCount(); ++t) CHECK(areas[t] == Approx(areaAlong(input, t, input, t)).epsilon(1e-12));
}

const Mesh kCrossingBoxes = merged({cube(1, 3), cube(2, 4), flipped(box({5, 1, 1}, {6, 2, 2}))});
struct RuleVolume {
  WindingRule rule;
  double volume;
};
constexpr RuleVolume kCrossingVolumes[] = {{WindingRule::positive, 15}, {WindingRule::nonZero, 16}, {WindingRule::odd, 15}};

/// The boundary of the solid inside the grid: closed, and of the volume of the regions inside. Returns its volume by the first rule.
double requireBoundary(const Mesh& mesh, const Grid& grid) {
  const CheckedCut cut = checkedCut(mesh, grid);
  const std::vector<double> volumes = regionVolumes(cut.mesh, cut.measures);
  double first = -1;
  for (const WindingRule rule : kRules) {
    CAPTURE(int(rule));
    const Mesh result = boundary(cut.mesh, rule);
    requireClosed(result);
    double expected = 0;
    for (size_t r = 0; r < volumes.size(); ++r) expected += isInside(cut.mesh.regionWinding[r], rule) ? volumes[r] : 0;
    const double volume = signedVolume(result);
    CHECK(volume == Approx(expected).epsilon(1e-12).margin(1e-12));
    if (first < 0) first = volume;
  }
  return first;
}

/// How many triangles lie in the sides of a grid.
size_t trianglesInSides(const Mesh& mesh, const Grid& grid) {
  size_t count = 0;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    for (size_t d = 0; d < 3; ++d) {
      for (const double plane : {grid.planes[d].front(), grid.planes[d].back()}) {
        bool lies = true;
        for (size_t i = 0; i < 3; ++i) lies &= mesh.positions[3 * size_t(mesh.triangles[3 * t + i]) + d] == plane;
        count += lies;
      }
    }
  }
  return count;
}

}  // namespace

// ----------------------------------------------------------------------------------------------------------------------- resolve

TEST_CASE("resolve: crossing boxes, their pieces and their winding numbers", "[resolve]") {
  const ResolveResult result = resolve(kCrossingBoxes);
  REQUIRE(result);
  const ResolvedMesh& resolved = result.mesh;
  requireClosed(resolved.mesh);
  requireCovered(kCrossingBoxes, resolved);
  CHECK(result.stats.intersections.total() > 0);
  CHECK(result.remaining.total() == 0);
  REQUIRE(resolved.hasWinding);
  for (size_t t = 0; t < resolved.mesh.triangleCount(); ++t) {
    const bool ofInverted = resolved.parents[resolved.parentOffsets[t]] >= 24;
    CHECK(resolved.backWinding[t] == resolved.frontWinding[t] + 1);
    CHECK(resolved.backWinding[t] >= (ofInverted ? 0 : 1));
    CHECK(resolved.backWinding[t] <= (ofInverted ? 0 : 2));
  }
  for (size_t v = 0; v < resolved.mesh.vertexCount(); ++v) {
    const int32_t old = resolved.vertexTriVertex[v];
    if (old >= 0) CHECK(pointAt(resolved.mesh.positions, uint32_t(v)) == pointAt(kCrossingBoxes.positions, uint32_t(old)));
  }
}

TEST_CASE("resolve: triangles that lie on each other, in both directions", "[resolve]") {
  const Mesh stacked = merged({cube(1, 2), flipped(cube(1, 2)), box({1, 1, 2}, {3, 3, 3}), box({2, 1, 1}, {3, 2, 2})});
  const ResolveResult result = resolve(stacked);
  REQUIRE(result);
  requireCovered(stacked, result.mesh);
  for (const WindingRule rule : kRules) {
    const Mesh solid = boundary(result.mesh, rule);
    requireClosed(solid);
    CHECK(signedVolume(solid) == Approx(5));
  }
}

TEST_CASE("resolve: an open mesh has no winding numbers, and no boundary", "[resolve]") {
  const Mesh sheets = merged({quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}), quad({1, 1, -1}, {1, 1, 1}, {1, 3, 1}, {1, 3, -1})});
  const ResolveResult result = resolve(sheets);
  REQUIRE(result);
  requireCovered(sheets, result.mesh);
  CHECK_FALSE(result.mesh.hasWinding);
  CHECK(result.mesh.frontWinding.empty());
  CHECK_THROWS_AS(boundary(result.mesh), CallError);
  CHECK_THROWS_AS(boundary(checkedCut(sheets, Grid::box({-1, -1, -2}, {3, 4, 2}, {4, 5, 4})).mesh), CallError);
}

namespace {

/// Two rings that cross so often that some of the rounded crossings meet again.
Mesh crossingRings() {
  const Mesh ring = torus({0, 0, 0}, 1, 0.3, 40, 20);
  return merged({ring, translated(permuted(ring, {1, 2, 0}), {0.1, 0.3, 0.2}), translated(permuted(ring, {2, 0, 1}), {0.37, 0.01, 0.13})});
}

}  // namespace

TEST_CASE("resolve: pairs that rounding brings back are counted", "[resolve]") {
  const Mesh rings = crossingRings();
  const ResolveResult result = resolve(rings);
  REQUIRE(result);
  CHECK(result.remaining.total() > 0);
  CHECK(result.remaining.total() < result.stats.intersections.total() / 10);
  CHECK(result.remaining.total() == findIntersections(result.mesh.mesh).counts.total());
}

TEST_CASE("resolve: progress goes on to the end, and ends the call at any stage", "[resolve]") {
  const Mesh rings = crossingRings();
  int last = 0, count = 0;
  RunOptions options;
  options.progress = [&](const Progress& progress) {
    if (count == 0) count = progress.stageCount;
    CHECK(progress.stageCount == count);
    CHECK(progress.stageIndex >= last);
    last = progress.stageIndex;
    return true;
  };
  REQUIRE(resolve(rings, options));
  CHECK(last == count - 1);
  for (int stage = 0; stage < count; ++stage) {
    CAPTURE(stage);
    options.progress = [&](const Progress& progress) { return progress.stageIndex < stage; };
    const ResolveResult result = resolve(rings, options);
    CHECK(result.error.status == Status::cancelled);
    CHECK(result.mesh.mesh.triangles.empty());
    options.progress = [&](const Progress& progress) {
      if (progress.stageIndex == stage) throw CallError({Status::badArgument, stage, -1, "The caller's own."});
      return true;
    };
    CHECK_THROWS_WITH(resolve(rings, options), "The caller's own.");
  }
}

// ---------------------------------------------------------------------------------------------------------------------- boundary

TEST_CASE("boundary: crossing and inverted boxes by each rule", "[resolve]") {
  const ResolveResult result = resolve(kCrossingBoxes);
  const CutMesh cutMesh = checkedCut(kCrossingBoxes, unitGrid(7)).mesh;
  for (const auto& [rule, volume] : kCrossingVolumes) {
    CAPTURE(int(rule));
    const Mesh ofResolved = boundary(result.mesh, rule), ofCut = boundary(cutMesh, rule);
    requireClosed(ofResolved);
    requireClosed(ofCut);
    CHECK(signedVolume(ofResolved) == Approx(volume));
    CHECK(signedVolume(ofCut) == Approx(volume));
  }
  const Mesh inverted = flipped(cube(1, 2));
  CHECK(boundary(resolve(inverted).mesh).triangles.empty());
}

TEST_CASE("boundary: the sides of the grid close a solid that reaches them", "[resolve]") {
  struct Reaching {
    const char* name;
    Mesh mesh;
    double volume;
  };
  const Reaching all[] = {
      {"one side", box({1.25, 1.25, 1.25}, {2.5, 2.5, 9}), 1.25 * 1.25 * 6.75},
      {"two sides at an edge", box({1.25, -1, -1}, {2.5, 5.5, 2.5}), 1.25 * 5.5 * 2.5},
      {"three sides at a corner", cube(-1, 5.5), 5.5 * 5.5 * 5.5},
      {"opposite sides", box({-1, -1, 1.25}, {9, 9, 3.5}), 8 * 8 * 2.25},
      {"all sides, past all planes", cube(-1, 9), 512},
      {"all sides, but for a cavity", merged({cube(-1, 9), flipped(cube(2.5, 5.25))}), 512 - 2.75 * 2.75 * 2.75},
      {"all sides, but for a cavity that touches an edge of two squares from one of them",
       merged({cube(-1, 9), flipped(tetrahedron({2.5, 3, 0}, {2.75, 3.5, 0.5}, {2.25, 3.5, 0.5}, {2.5, 3.25, 0.75}))}), 512 - 1.0 / 48},
      {"lying in one side from inside", box({1, 1, 0}, {6.5, 6.5, 2}), 5.5 * 5.5 * 2},
      {"lying in one side from outside", box({1, 1, -3}, {6.5, 6.5, 0}), 0},
      {"in planes of the grid", box({-1, 2, 3}, {7, 5, 9}), 7 * 3 * 5},
      {"through cut-cells alone", box({1.25, 1.25, 7.5}, {1.5, 1.5, 9}), 0.25 * 0.25 * 0.5},
      {"in two parts that overlap there", merged({box({-1, 1.5, 1.5}, {5, 4, 4}), box({-2, 2, 2}, {3, 6, 6})}), 31.25 + 48 - 12},
  };
  for (const auto& [name, mesh, volume] : all) {
    CAPTURE(name);
    CHECK(requireBoundary(mesh, unitGrid(8)) == Approx(volume).margin(1e-12));
  }
}

TEST_CASE("boundary: balls about all parts of a grid's sides, in grids of any counts", "[resolve]") {
  const Mesh ball = icosphere({0, 0, 0}, 2.3, 2);
  for (const Grid& grid : {unitGrid(13, 7, 5), Grid::box({0, 0, 0}, {13, 7, 5}, {31, 6, 1}),
                           Grid::rectilinear({{{0, 0.25, 1, 4, 4.5, 9, 13}, {0, 3, 3.5, 7}, {0, 2, 2.5, 2.625, 3, 5}}})}) {
    for (const double x : {0.0, 6.1, 13.0}) {
      for (const double y : {0.3, 3.4, 8.1}) {
        for (const double z : {-1.0, 2.6, 5.0}) {
          CAPTURE(x, y, z);
          requireBoundary(translated(ball, {x, y, z}), grid);
        }
      }
    }
  }
}

TEST_CASE("boundary: of all cases", "[resolve]") {
  size_t closed = 0;
  for (const NamedCase& c : caseList()) {
    CAPTURE(c.name);
    if (!checkedCut(c.mesh, c.grid).mesh.hasWinding) continue;
    ++closed;
    requireBoundary(c.mesh, c.grid);
    requireBoundary(merged({c.mesh, cube(-20, 30)}), c.grid);
  }
  CHECK(closed > 10);
}

TEST_CASE("boundary: large squares where nothing is cut", "[resolve]") {
  const Grid grid = unitGrid(64);
  const Mesh mesh = merged({cube(-1, 65), flipped(cube(2.25, 2.5))});
  CHECK(requireBoundary(mesh, grid) == Approx(64 * 64 * 64 - 1.0 / 64));
  const size_t count = trianglesInSides(boundary(checkedCut(mesh, grid).mesh), grid);
  CHECK(count >= 12);
  CHECK(count < 1000);  // of 49152 in single squares
}
