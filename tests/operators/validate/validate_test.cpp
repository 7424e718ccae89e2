// validate(): right cut-meshes pass, garbage is named, and how results and progress are told.
#include <algorithm>
#include <ctime>
#include <functional>
#include <limits>

#include "catch.h"
#include "mandoline/mandoline.h"
#include "shapes.h"
#include "sketches.h"

using namespace mandoline;
using namespace sketches;

namespace {

void makeVertex(CutMesh& cut, uint32_t v, MadeVertex kind, const std::array<int32_t, 4>& parents) {
  cut.madeVertices.push_back(v);
  cut.madeVertexKinds.push_back(uint8_t(kind));
  cut.madeVertexParents.insert(cut.madeVertexParents.end(), parents.begin(), parents.end());
}

}  // namespace

TEST_CASE("validate: right cut-meshes pass", "[validate]") {
  requirePass(Halves().validated());
  requirePass(bubble().validated());
  requirePass(Shelf(false).validated());
  requirePass(Shelf(true).validated());
}

TEST_CASE("validate: checks that do not apply say why", "[validate]") {
  const Validation open = Halves().validated();
  for (const char* name : {"windingNumber", "inputVolume"}) {
    CHECK(checkNamed(open, name).skipped);
    CHECK_FALSE(checkNamed(open, name).message.empty());
  }
  const Validation closed = bubble().validated();
  for (const char* name : {"windingNumber", "inputVolume"}) CHECK_FALSE(checkNamed(closed, name).skipped);
}

TEST_CASE("validate: garbage arrays are named, not followed", "[validate]") {
  using Break = std::function<void(CutMesh&)>;
  const std::vector<Break> breaks{
      [](CutMesh& c) { c.positions.pop_back(); },
      [](CutMesh& c) { c.positions[4] = std::numeric_limits<double>::quiet_NaN(); },
      [](CutMesh& c) { c.vertexCell[0] = 7; },
      [](CutMesh& c) { c.vertexMask[0] = 9; },
      [](CutMesh& c) { c.vertexTriVertex[0] = 99; },
      [](CutMesh& c) { c.vertexParents[0] = 99; },
      [](CutMesh& c) { c.loopOffsets[1] = 1000; },
      [](CutMesh& c) { c.loopOffsets.clear(); },
      [](CutMesh& c) { c.loopVertices[3] = 1000; },
      [](CutMesh& c) { c.loopVertices[1] = c.loopVertices[0]; },
      [](CutMesh& c) { std::swap(c.faceLoopOffsets[1], c.faceLoopOffsets[2]); },
      [](CutMesh& c) { c.faceTriangle[0] = 1000; },
      [](CutMesh& c) { c.faceTriangle[6] = 1; },
      [](CutMesh& c) { c.faceTriangle[6] = -1; },
      [](CutMesh& c) { c.faceParentOffsets.pop_back(); },
      [](CutMesh& c) { c.faceParentOffsets[7] = 1000; },
      [](CutMesh& c) { c.faceParents[0] = 1000; },
      [](CutMesh& c) { c.faceParents.push_back(0); },
      [](CutMesh& c) { c.faceParentSigns[0] = -1; },
      [](CutMesh& c) { c.faceParentSigns[0] = 2; },
      [](CutMesh& c) { c.faceParentSigns.pop_back(); },
      [](CutMesh& c) {  // twice the same
        std::fill(c.faceParentOffsets.begin() + 7, c.faceParentOffsets.end(), 4u);
        c.faceParents = {0, 0, 1, 2};
      },
      [](CutMesh& c) { c.madeVertices = {0}; },
      [](CutMesh& c) {
        makeVertex(c, 1000, MadeVertex::triangles, {0, 1, 2, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 8, MadeVertex::triangles, {0, 1, 2, -1});
      },  // a tri-vertex
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex(4), {0, 1, 2, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::triangles, {0, 1, 4, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::triangles, {0, 1, 2, 3});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::trianglesPlane, {0, -1, -1, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::edgeTriangle, {0, 4, 0, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::edgeEdge, {0, 1, 2, 4});
      },
      [](CutMesh& c) { c.faceAxis[0] = 3; },
      [](CutMesh& c) { c.facePlane[0] = 1000; },
      [](CutMesh& c) { c.cellHalfFaces[0] = 1000; },
      [](CutMesh& c) { c.cellHalfFaceOffsets.back()--; },
      [](CutMesh& c) { c.cellGridCell[0] = -1; },
      [](CutMesh& c) { c.cellRegion[0] = 9; },
      [](CutMesh& c) { c.rowRunOffsets.pop_back(); },
      [](CutMesh& c) { c.runEnd[0] = 3; },
      [](CutMesh& c) { c.runRegion[0] = 9; },
      [](CutMesh& c) { c.regionWinding.pop_back(); },
      [](CutMesh& c) { c.triangleCount = 3; },
      [](CutMesh& c) { c.droppedTriangles = {77}; },
      [](CutMesh& c) {
        c.grid.planes[0] = {0, 2, 1};
      },
      [](CutMesh& c) { c.grid.planes[1].clear(); },
      [](CutMesh& c) {
        c.grid.planes[2] = {0, 1e-320, 1};
      },
      [](CutMesh& c) { c = CutMesh(); },
  };
  for (size_t i = 0; i < breaks.size(); ++i) {
    INFO("break " << i);
    Bubbles b = bubble();
    breaks[i](b.cut);
    const Validation validation = b.validated();
    CHECK_FALSE(validation.pass);
    REQUIRE(validation.checks.size() == 1);
    CHECK(validation.checks[0].name == "arrays");
    CHECK_FALSE(validation.checks[0].message.empty());
  }
}

TEST_CASE("validate: messages are sentences without counts of roundings", "[validate]") {
  SECTION("of a measure") {
    Halves h;
    h.mesh.triangles.insert(h.mesh.triangles.end(), {0, 2, 1});
    h.cut.triangleCount = 3;
    h.mesh.positions.insert(h.mesh.positions.end(), {1, 0.5, 0.75});
    h.mesh.triangles.back() = 4;
    const Check check = checkNamed(h.validated(), "surfaceArea");
    CHECK(check.worst > 1e10);
    CHECK(check.tolerance == 64);
    CHECK(check.message == "Triangle 2 is covered by faces whose area differs from its own by 100%.");
  }
  SECTION("of a small deviation") {
    Halves h;
    h.cut.positions[3 * h.vertex({1, 0, 0.5}) + 2] += 1e-12;
    CHECK(checkNamed(h.validated(), "planarity").message ==
          "Face 0 has a vertex that is off its triangle by less than 0.01% of the largest coordinate, more than rounding explains.");
  }
  SECTION("of violations") {
    Bubbles b = bubble();
    b.cut.droppedTriangles = {0};
    CHECK(checkNamed(b.validated(), "faces").message == "Face 6 names a dropped triangle.");
    b.cut.droppedTriangles = {0, 1};
    CHECK(checkNamed(b.validated(), "faces").message == "Face 6 names a dropped triangle. There are 2 violations in all.");
  }
  SECTION("of the grid") {
    Bubbles b = bubble();
    b.cut.runBegin.clear(), b.cut.runEnd.clear(), b.cut.runRegion.clear();
    b.finishRow();
    CHECK(checkNamed(b.validated(), "stencil").message == "The grid has cells that are neither cut nor untouched, or both.");
  }
  SECTION("of arrays") {
    Bubbles b = bubble();
    b.cut.positions.pop_back();
    CHECK(checkNamed(b.validated(), "arrays").message == "An array of the vertices has a wrong length. All other checks are left out.");
  }
}

TEST_CASE("validate: the same bits for any number of threads", "[validate]") {
  const Mesh mesh = shapes::noisySphere({0, 0, 0}, 1, 0.1, 5);
  const CutResult result = cut(mesh, Grid::around(mesh, 24));
  REQUIRE(result);
  REQUIRE(result.mesh.faceCount() > 3 * 2048);
  CutMesh damaged = result.mesh;
  for (size_t i = 0; i < damaged.faceParents.size(); i += 1000) damaged.faceParents[i] = 0;
  for (size_t f = 0; f < damaged.faceCount(); ++f) {
    if (damaged.faceTriangle[f] >= 0) damaged.faceTriangle[f] = int32_t(damaged.faceParents[damaged.faceParentOffsets[f]]);
  }
  damaged.positions[3 * damaged.loopVertices[0]] += 0.001;
  for (const CutMesh* cutMesh : {&result.mesh, static_cast<const CutMesh*>(&damaged)}) {
    RunOptions options;
    options.threads = 1;
    const Validation one = validate(mesh, *cutMesh, options);
    for (const unsigned threads : {0u, 2u, 7u}) {
      options.threads = threads;
      const Validation many = validate(mesh, *cutMesh, options);
      REQUIRE(many.checks.size() == one.checks.size());
      for (size_t i = 0; i < one.checks.size(); ++i) {
        const Check &a = one.checks[i], &b = many.checks[i];
        INFO(a.name);
        CHECK(a.worst == b.worst);
        CHECK((a.element == b.element && a.elementKind == b.elementKind && a.message == b.message && a.pass == b.pass));
      }
    }
  }
}

TEST_CASE("validate: progress ascends, and cancels", "[validate]") {
  const Mesh mesh = shapes::noisySphere({0, 0, 0}, 1, 0.1, 4);
  const CutResult result = cut(mesh, Grid::around(mesh, 12));
  REQUIRE(result);
  int calls = 0, stage = -1;
  RunOptions options;
  options.progress = [&](const Progress& progress) {
    ++calls;
    CHECK(progress.stageIndex >= stage);
    CHECK(progress.stageIndex < progress.stageCount);
    CHECK(progress.done <= progress.total);
    stage = progress.stageIndex;
    return true;
  };
  requirePass(validate(mesh, result.mesh, options));
  CHECK(calls > 10);
  for (int last = 0; last < calls; last += 3) {
    int left = last;
    options.progress = [&](const Progress&) { return left-- > 0; };
    try {
      validate(mesh, result.mesh, options);
      FAIL("not cancelled");
    } catch (const CallError& error) {
      CHECK(error.error.status == Status::cancelled);
      CHECK(left == -1);
    }
  }
  struct OfTheCaller {};
  options.progress = [](const Progress&) -> bool { throw OfTheCaller(); };
  CHECK_THROWS_AS(validate(mesh, result.mesh, options), OfTheCaller);
}

TEST_CASE("validate: small triangles crowded in a grid cell take as long as large ones that fill it", "[validate]") {
  const Mesh spheres = shapes::merged({shapes::icosphere({0.3, 0.3, 0.3}, 0.25, 4), shapes::icosphere({0.3, 0.3, 0.3}, 0.125, 4),
                                       shapes::icosphere({0.7, 0.7, 0.7}, 0.25, 4)});
  const auto processorTime = [](const Mesh& mesh) {
    const CutResult result = cut(mesh, Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
    REQUIRE(result);
    REQUIRE(result.mesh.cellCount() == 4);
    RunOptions options;
    options.threads = 1;
    std::clock_t least = 0;
    for (int run = 0; run < 3; ++run) {
      const std::clock_t start = std::clock();
      requirePass(validate(mesh, result.mesh, options));
      const std::clock_t time = std::clock() - start;
      least = run == 0 ? time : std::min(least, time);
    }
    return least;
  };
  constexpr double kSmall = 0x1p-12;
  CHECK(processorTime(shapes::translated(shapes::scaled(spheres, {kSmall, kSmall, kSmall}), {0.5, 0.5, 0.5})) < 5 * processorTime(spheres));
}

TEST_CASE("validate: a mesh that is not the input fails by name", "[validate]") {
  const Bubbles b = bubble();
  const auto failing = [&](const Mesh& mesh) {
    const Validation validation = validate(mesh, b.cut);
    CHECK_FALSE(validation.pass);
    const auto found = std::find_if(validation.checks.begin(), validation.checks.end(), [](const Check& c) { return !c.pass; });
    return found == validation.checks.end() ? "" : found->name;
  };
  CHECK(failing(Mesh{}) == "arrays");
  CHECK(failing(shapes::cube(0, 1)) == "arrays");
  Mesh mesh = b.mesh;
  mesh.positions.resize(9);
  CHECK(failing(mesh) == "arrays");
  mesh = b.mesh;
  mesh.positions[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(failing(mesh) == "arrays");
  mesh.positions[0] = 1e300;
  CHECK(failing(mesh) == "arrays");
  mesh.positions[0] = 0.125;
  CHECK(failing(mesh) == "vertices");
}

TEST_CASE("validate: a snap tolerance that cut() would not take is none of a cut-mesh", "[validate]") {
  Bubbles b = bubble();
  for (const double tolerance : {-0.1, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    b.cut.snapTolerance = tolerance;
    CHECK(b.validated().checks.size() == 1);
    CHECK_FALSE(b.validated().pass);
  }
}

TEST_CASE("validate: right results on inputs that strain rounding", "[validate]") {
  const auto requireCut = [](const Mesh& mesh, const Grid& grid, double snapTolerance = 0) {
    CutOptions options;
    options.snapTolerance = snapTolerance;
    const CutResult result = cut(mesh, grid, options);
    INFO(result.error.message);
    REQUIRE(result);
    CHECK(result.mesh.snapTolerance == snapTolerance);
    requirePass(validate(mesh, result.mesh));
  };
  const double ulp = 0x1p-52;
  const Mesh octahedron{{0.9, 0, 0, -0.9, 0, 0, 0, 0.9, 0, 0, -0.9, 0, 0, 0, 0.9, 0, 0, -0.9},
                        {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};
  const auto moved = [&](double by, double scale) {
    Mesh mesh = octahedron;
    for (double& x : mesh.positions) x = x * scale + by;
    return mesh;
  };
  SECTION("far from the origin") {
    requireCut(moved(1e6, 1), Grid::box({1e6 - 1, 1e6 - 1, 1e6 - 1}, {1e6 + 1, 1e6 + 1, 1e6 + 1}, {7, 8, 9}));
  }
  SECTION("huge and tiny") {
    requireCut(moved(0, 1e150), Grid::box({-1e150, -1e150, -1e150}, {1e150, 1e150, 1e150}, {3, 4, 5}));
    requireCut(moved(0, 1e-150), Grid::box({-1e-150, -1e-150, -1e-150}, {1e-150, 1e-150, 1e-150}, {3, 4, 5}));
  }
  SECTION("slabs of one ulp") {
    requireCut(octahedron,
               Grid::rectilinear({{{-1, -0.5, 0.5, 0.5 + ulp, 0.5 + 2 * ulp, 1}, {-1, 0, ulp, 1}, {-1, 0.25, 0.25 + ulp, 0.5, 1}}}));
  }
  SECTION("boxes of different sides") {
    requireCut(Mesh{{0, 0, 1e-9, 900, 0, 1e-9, 0, 0.01, 2e-9}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1000, 0.02, 3e-9}, {9, 8, 7}));
  }
  SECTION("needles and a triangle that is almost flat") {
    requireCut(Mesh{{0.1, 0.1, 0.1, 0.9, 0.8, 0.7, 0.5, 0.45, 0.4 + 1e-13}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1, 1, 1}, {13, 13, 13}));
    requireCut(Mesh{{0, 0, 0, 1, 1, 1, 0.5, 0.5, 0.5 + ulp}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1, 1, 1}, {10, 10, 10}));
  }
  SECTION("two sheets one ulp apart") {
    const double z = 0.3, up = std::nextafter(z, 1);
    requireCut(Mesh{{0.1, 0.1, z, 0.9, 0.1, z, 0.1, 0.9, z, 0.1, 0.1, up, 0.9, 0.1, up, 0.1, 0.9, up}, {0, 1, 2, 3, 4, 5}},
               Grid::box({0, 0, 0}, {1, 1, 1}, {5, 5, 5}));
    requireCut(Mesh{{0.1, 0.1, z, 0.9, 0.1, z, 0.1, 0.9, z, 0.1, 0.1, up, 0.9, 0.1, up, 0.1, 0.9, up}, {0, 1, 2, 3, 4, 5}},
               Grid::box({0, 0, 0}, {1, 1, 1}, {10, 10, 10}));
  }
  SECTION("corners far outside") {
    requireCut(Mesh{{-1e5, -1e5, 0.3, 1e5, -1e5, 0.7, 0, 2e5, 0.5}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1, 1, 1}, {6, 6, 6}));
  }
  SECTION("vertices snapped onto planes") {
    requireCut(moved(0.001, 1), Grid::box({-1, -1, -1}, {1, 1, 1}, {20, 20, 20}), 0.05);
    requireCut(moved(0.001, 1.11), Grid::rectilinear({{{-1, -0.5, 0, 1}, {-2, -1, 0.1, 1, 2}, {-1, -0.95, 0, 0.9, 1}}}), 0.2);
  }
  SECTION("nothing but a triangle without area") {
    requireCut(Mesh{{0, 0, 0, 1, 1, 0, 3, 3, 0}, {0, 1, 2}}, Grid::box({0, 0, -1}, {3, 3, 2}, {3, 3, 3}));
  }
  SECTION("a surface that touches the box from outside") {
    requireCut(Mesh{{1, 0.2, 0.5, 1, 0.7, 0.5, 2, 0.5, 0.5}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1, 1, 1}, {3, 3, 3}));
  }
  SECTION("a dropped triangle without area in a crack") {
    requireCut(Mesh{{0, 0, 0.5, 1, 0, 0.5, 0.5, 0, 0.5, 0.5, 0.9, 0.3, 0.5, -0.9, 0.3}, {0, 1, 3, 2, 0, 4, 1, 2, 4, 0, 2, 1}},
               Grid::box({-1, -1, -1}, {2, 2, 2}, {7, 7, 7}));
  }
}
