// orient(): triangles agree, closed patches face outward, cavities inward.
#include "mandoline/orient.h"

#include <algorithm>
#include <random>

#include "catch.h"
#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#include "mesh_folder.h"
#include "refusal.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

/// Turns about half of the triangles, always the same ones; says which.
Mesh withRandomTurns(Mesh mesh, unsigned seed, std::vector<uint32_t>* turned = nullptr) {
  std::mt19937 random(seed);
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    if (random() % 2 == 0) continue;
    std::swap(mesh.triangles[3 * size_t(t) + 1], mesh.triangles[3 * size_t(t) + 2]);
    if (turned) turned->push_back(t);
  }
  return mesh;
}

/// Each triangle with its lowest vertex first, so that only its direction counts.
std::vector<std::array<uint32_t, 3>> directed(const Mesh& mesh) {
  std::vector<std::array<uint32_t, 3>> triangles;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<uint32_t, 3> v = {mesh.triangles[3 * t], mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]};
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    triangles.push_back(v);
  }
  return triangles;
}

CutMesh cutOf(const Mesh& mesh, int64_t cells) {
  CutResult result = cut(mesh, Grid::around(mesh, cells));
  REQUIRE(result);
  return std::move(result.mesh);
}

std::vector<int32_t> windingsOf(const Mesh& mesh) {
  const CutMesh cutMesh = cutOf(mesh, 7);
  REQUIRE(cutMesh.hasWinding);
  std::vector<int32_t> windings = cutMesh.regionWinding;
  std::sort(windings.begin(), windings.end());
  return windings;
}

using Windings = std::vector<int32_t>;
using Facings = std::vector<Facing>;

/// Of a temporary, too.
OrientedMesh orientationOf(const Mesh& mesh) { return orient(mesh); }

}  // namespace

TEST_CASE("Closed meshes with random triangles turned come back as they were", "[orient]") {
  const Mesh meshes[] = {shapes::cube(0, 1),
                         shapes::octahedron({0, 0, 0}, 1),
                         shapes::unwelded(shapes::icosphere({1, 2, 3}, 2, 3)),
                         shapes::torus({0, 0, 0}, 3, 1, 24, 12),
                         shapes::prism({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, 0, 1),
                         shapes::emptyCone(),
                         shapes::claw(),
                         shapes::oscillator(12),
                         shapes::sweptTube(shapes::hilbertCurve(2), 0.2),
                         shapes::scaled(shapes::cube(0, 1), {1e-200, 1e-200, 1e-200})};
  for (const Mesh& mesh : meshes) {
    for (const unsigned seed : {1u, 2u, 3u}) {
      std::vector<uint32_t> turned;
      const OrientedMesh oriented = orientationOf(withRandomTurns(mesh, seed, &turned));
      REQUIRE(directed(oriented.mesh) == directed(mesh));
      REQUIRE(oriented.mesh.positions == mesh.positions);
      REQUIRE(oriented.turnedTriangles == turned);
      REQUIRE(oriented.patchFacing == Facings{Facing::outward});
    }
    CHECK(windingsOf(orientationOf(shapes::flipped(mesh)).mesh) == Windings{0, 1});
  }
}

TEST_CASE("Boxes inside each other bound solid, cavity, solid", "[orient]") {
  const Mesh mesh = shapes::merged({shapes::cube(2, 6), shapes::cube(0, 8), shapes::cube(3, 5), shapes::cube(10, 12)});
  const OrientedMesh oriented = orientationOf(withRandomTurns(mesh, 5));
  CHECK(oriented.patchFacing == Facings{Facing::inward, Facing::outward, Facing::outward, Facing::outward});
  CHECK(windingsOf(oriented.mesh) == Windings{0, 0, 1, 1, 1});
  CHECK(oriented.trianglePatch[11] == 0);
  CHECK(oriented.trianglePatch[12] == 1);
}

TEST_CASE("A patch inside another may touch it", "[orient]") {
  const Mesh cube = shapes::cube(0, 2);
  SECTION("from inside, with vertices in its sides") {
    const OrientedMesh oriented = orientationOf(shapes::merged({shapes::octahedron({1, 1, 1}, 1), cube}));
    CHECK(oriented.patchFacing == Facings{Facing::inward, Facing::outward});
  }
  SECTION("from outside, side on side") {
    const OrientedMesh oriented = orientationOf(shapes::merged({shapes::box({0.5, 0.5, 2}, {1.5, 1.5, 3}), cube}));
    CHECK(oriented.patchFacing == Facings{Facing::outward, Facing::outward});
  }
  SECTION("from inside, side on side") {
    const OrientedMesh oriented = orientationOf(shapes::merged({shapes::box({0.5, 0.5, 1}, {1.5, 1.5, 2}), cube}));
    CHECK(oriented.patchFacing == Facings{Facing::inward, Facing::outward});
  }
  SECTION("being the same, in other triangles") {
    Mesh other = shapes::withSplitTriangle(cube, 0);
    for (double& x : other.positions) x += 0;
    CHECK(orientationOf(shapes::merged({shapes::translated(other, {0, 0, 0}), shapes::cube(4, 5)})).patchFacing ==
          Facings{Facing::outward, Facing::outward});
  }
  SECTION("along an edge of four triangles") {
    const OrientedMesh oriented = orientationOf(withRandomTurns(shapes::merged({cube, shapes::box({2, 2, 0}, {4, 4, 2})}), 3));
    CHECK(oriented.patchFacing == Facings{Facing::outward, Facing::outward});
  }
}

TEST_CASE("Parts that cross do not lie inside each other, even where all vertices of one do", "[orient]") {
  const Mesh crossing = shapes::merged({shapes::cube(0, 2), shapes::cube(1, 3)});
  CHECK(orientationOf(crossing).patchFacing == Facings{Facing::outward, Facing::outward});
  CHECK(windingsOf(orientationOf(shapes::flipped(crossing)).mesh) == Windings{0, 1, 1, 2});
  const Mesh horseshoe = shapes::prism({{0, 0}, {6, 0}, {6, 6}, {4, 6}, {4, 2}, {2, 2}, {2, 6}, {0, 6}}, 0, 3);
  const Mesh bridge = shapes::box({1, 4, 1}, {5, 5, 2});  // from arm to arm
  CHECK(orientationOf(shapes::merged({horseshoe, bridge})).patchFacing == Facings{Facing::outward, Facing::outward});
}

TEST_CASE("Patches that only together close their edges face away from what they enclose", "[orient]") {
  const Mesh spheres = shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::icosphere({1, 0.1, 0.2}, 1, 2)});
  const ResolveResult resolved = resolve(spheres);
  REQUIRE(resolved);
  const OrientedMesh oriented = orientationOf(withRandomTurns(resolved.mesh.mesh, 7));
  CHECK(oriented.patchFacing == Facings(4, Facing::outward));
  CHECK(inspect(oriented.mesh).oriented);
  CHECK(windingsOf(oriented.mesh) == Windings{0, 0, 1, 1});  // what both spheres hold is outside, as by the odd rule
}

TEST_CASE("A Moebius strip can't be oriented: it is left as it is, and what is beside it is not", "[orient]") {
  const Mesh strip = shapes::moebius({0, 0, 0}, 3, 1, 20);
  const Mesh mesh = withRandomTurns(shapes::merged({strip, shapes::cube(10, 11)}), 2);
  const OrientedMesh oriented = orientationOf(mesh);
  CHECK(oriented.patchFacing == Facings{Facing::nonOrientable, Facing::outward});
  CHECK(std::equal(mesh.triangles.begin(), mesh.triangles.begin() + ptrdiff_t(strip.triangles.size()), oriented.mesh.triangles.begin()));
  CHECK(shapes::signedVolume(Mesh{oriented.mesh.positions,
                                  {oriented.mesh.triangles.begin() + ptrdiff_t(strip.triangles.size()), oriented.mesh.triangles.end()}}) ==
        1);
}

TEST_CASE("Open patches face outward where every way to close them tells the same, else most triangles stay", "[orient]") {
  Mesh hemisphere = shapes::icosphere({0, 0, 0}, 1, 3);
  std::vector<uint32_t> upper;
  for (size_t t = 0; t < hemisphere.triangleCount(); ++t) {
    const uint32_t* v = &hemisphere.triangles[3 * t];
    const double height = hemisphere.positions[3 * v[0] + 2] + hemisphere.positions[3 * v[1] + 2] + hemisphere.positions[3 * v[2] + 2];
    if (height > 0) upper.insert(upper.end(), v, v + 3);
  }
  hemisphere.triangles = upper;
  const OrientedMesh dome = orientationOf(shapes::flipped(hemisphere));
  CHECK(dome.patchFacing == Facings{Facing::outward});
  CHECK(dome.turnedTriangles.size() == hemisphere.triangleCount());
  CHECK(directed(dome.mesh) == directed(hemisphere));

  Mesh wave = shapes::sheet(9, 9, [](int i, int j) { return shapes::Point{double(i), double(j), double((i / 3 + j / 3) % 2)}; });
  for (const Mesh& sheet : {wave, shapes::flipped(wave), shapes::quad({0, 0, 0}, {3, 0, 1}, {3, 3, 2}, {0, 3, 1})}) {
    Mesh mesh = sheet;
    std::swap(mesh.triangles[4], mesh.triangles[5]);
    if (sheet.triangleCount() == 2) std::swap(mesh.triangles[4], mesh.triangles[5]);
    const OrientedMesh oriented = orientationOf(mesh);
    CHECK(oriented.patchFacing == Facings{Facing::unknown});
    CHECK(directed(oriented.mesh) == directed(sheet));
    CHECK(oriented.turnedTriangles == (sheet.triangleCount() == 2 ? std::vector<uint32_t>{} : std::vector<uint32_t>{1}));
  }
}

TEST_CASE("A closed mesh without volume has no outside: most triangles stay", "[orient]") {
  const Mesh flat = shapes::tetrahedron({0, 0, 0}, {3, 1, 7}, {1, 3, 0.1}, {4, 4, 7.1});  // exact sums
  Mesh plane = shapes::tetrahedron({0, 0, 0}, {3, 1, 7}, {1, 3, 2}, {4, 4, 9});
  std::swap(plane.triangles[1], plane.triangles[2]);
  const OrientedMesh oriented = orientationOf(plane);
  CHECK(oriented.patchFacing == Facings{Facing::unknown});
  CHECK(oriented.turnedTriangles == std::vector<uint32_t>{0});
  CHECK(orientationOf(flat).patchFacing == Facings{Facing::outward});
}

TEST_CASE("Triangles without three vertices or without area are no trouble, and meshes that can't be cut are refused", "[orient]") {
  Mesh mesh = shapes::cube(0, 1);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  const OrientedMesh oriented = orientationOf(mesh);
  CHECK(oriented.trianglePatch[0] == -1);
  CHECK(oriented.turnedTriangles.empty());
  CHECK(orientationOf(Mesh{{0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 1, 2}}).patchFacing == Facings{Facing::unknown});
  using Refusal = std::pair<Status, int64_t>;
  const auto refused = [](const Mesh& bad) { return refusal([&] { orient(bad); }); };
  CHECK(refused({{0, 0, 0}, {0, 0, 1}}) == Refusal{Status::badIndex, 0});
  CHECK(refused({{0, 0}, {0, 0, 0}}) == Refusal{Status::badArrays, -1});
  CHECK(refused({}) == Refusal{Status::emptyMesh, -1});
  CHECK(refused({{0, 0, 0, 1, 0, 0, 0, NAN, 0}, {0, 1, 2}}) == Refusal{Status::nonFiniteCoordinate, 2});
  RunOptions cancelled;
  cancelled.progress = [](const Progress&) { return false; };
  CHECK(refusal([&] { orient(mesh, cancelled); }).first == Status::cancelled);
}

TEST_CASE(
    "Closed meshes of the collection are oriented, no matter which triangles were turned, and those that don't meet themselves wind once "
    "at most",
    "[orient]") {
  const auto folder = meshFolder();
  if (!folder) return;
  size_t closed = 0, repaired = 0, simple = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (entry.path().extension() != ".gz") continue;
    const Mesh mesh = readMesh(entry.path().string());
    const MeshInfo info = inspect(mesh);
    if (!info.closed || info.triangles > 100000) continue;
    CAPTURE(entry.path().filename().string());
    const OrientedMesh oriented = orientationOf(mesh), again = orientationOf(withRandomTurns(mesh, 11));
    if (std::count(oriented.patchFacing.begin(), oriented.patchFacing.end(), Facing::nonOrientable) > 0) continue;
    ++closed;
    repaired += !info.oriented;
    CHECK(inspect(oriented.mesh).oriented);
    CHECK(orientationOf(oriented.mesh).turnedTriangles.empty());
    CHECK(oriented.patchFacing == again.patchFacing);
    const auto a = directed(oriented.mesh), b = directed(again.mesh);
    size_t different = 0;
    for (size_t t = 0; t < a.size(); ++t) {
      const int32_t patch = oriented.trianglePatch[t];
      different += patch >= 0 && oriented.patchFacing[size_t(patch)] != Facing::unknown && a[t] != b[t];
    }
    CHECK(different == 0);
    const CutMesh cutMesh = cutOf(oriented.mesh, 5);
    CHECK(cutMesh.hasWinding);
    if (findIntersections(mesh, {{}, 0}).counts.total() > 0) continue;
    ++simple;
    const auto& windings = cutMesh.regionWinding;
    CHECK(std::all_of(windings.begin(), windings.end(), [](int32_t w) { return w == 0 || w == 1; }));
  }
  WARN(closed << " closed meshes, " << repaired << " of which were not oriented; " << simple << " do not meet themselves");
  CHECK(repaired > 0);
}

TEST_CASE("a mesh that is oriented as it is prepared is cut as the oriented one", "[orient]") {
  const Mesh mesh = withRandomTurns(shapes::merged({shapes::cube(0, 3), shapes::cube(1, 2)}), 8);
  const OrientedMesh oriented = orient(mesh);
  PrepareOptions options;
  options.orient = true;
  std::vector<std::pair<int, int>> stages;
  options.progress = [&](const Progress& progress) {
    if (stages.empty() || stages.back().first != progress.stageIndex) stages.push_back({progress.stageIndex, progress.stageCount});
    return true;
  };
  const PrepareResult prepared = prepare(mesh, options);
  REQUIRE(prepared);
  CHECK(stages == std::vector<std::pair<int, int>>{{0, 4}, {1, 4}, {2, 4}, {3, 4}});
  CHECK(std::equal(oriented.mesh.triangles.begin(), oriented.mesh.triangles.end(), prepared.mesh.mesh().triangles.begin()));
  const Grid grid = Grid::around(mesh, 5);
  const CutResult expected = cut(oriented.mesh, grid);
  CHECK(differences(cut(prepared.mesh, grid).mesh, expected.mesh).empty());
  CHECK(expected.mesh.hasWinding);
  CHECK(validate(prepared.mesh.mesh(), expected.mesh).pass);
  CutOptions snapping;
  snapping.snapTolerance = 0.1;  // prepares again
  CHECK(differences(cut(prepared.mesh, grid, snapping).mesh, cut(oriented.mesh, grid, snapping).mesh).empty());
  options.progress = [](const Progress& progress) { return progress.stageIndex < 1; };
  CHECK(prepare(mesh, options).error.status == Status::cancelled);
  options.progress = {};
  const Mesh nothing;
  CHECK(prepare(nothing, options).error.status == Status::emptyMesh);
}
