// The passes of validate() one by one: what each takes, returns, and sees by itself.
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "operators/validate/passes.h"
#include "rational.h"
#include "samples.h"
#include "shapes.h"

using namespace mandoline;
using namespace mandoline::validation;

namespace {

/// A cut-mesh to damage, and what the passes need to look at it.
struct Fixture {
  Fixture(const Mesh& mesh_, const Grid& grid) : mesh(mesh_), view(mesh), cutMesh(cut(mesh, grid).mesh) {
    REQUIRE(cutMesh.cellCount() > 0);
  }

  Context context() const { return Context(view, cutMesh); }

  Mesh mesh;
  MeshView view;
  CutMesh cutMesh;
  RunOptions options;
  detail::Monitor monitor{options, 1};
};

Fixture sphere() { return Fixture(shapes::icosphere({2, 2, 2}, 1.3, 2), unitGrid(4)); }

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum;
}

}  // namespace

TEST_CASE("validate: passes coordinates among the least doubles, and finds what is off there", "[validate]") {
  for (const int exponent : {-1022, -1030, -1045, -1060, -1068}) {
    CAPTURE(exponent);
    Mesh mesh = shapes::noisySphere({0.3, 0.4, 0.5}, 1, 0.1, 2);
    for (double& x : mesh.positions) x = std::ldexp(x, exponent);
    const CutResult result = cut(mesh, Grid::around(mesh, 5));
    REQUIRE(result);
    for (const Check& check : validate(mesh, result.mesh).checks) {
      CAPTURE(check.name, check.message);
      CHECK(check.pass);
    }
    if (exponent < -1060) continue;  // as many roundings as the tolerance has are all of the mesh
    CutMesh damaged = result.mesh;
    damaged.positions[3 * damaged.loopVertices[0]] += std::ldexp(0.125, exponent);
    CHECK_FALSE(validate(mesh, damaged).pass);
  }
}

TEST_CASE("validation arithmetic: signs are those of rational numbers", "[validate]") {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind, 7);
    for (int i = 0; i < 300; ++i) {
      const auto random = [&] { return Vec3{{sampler.coordinate(), sampler.coordinate(), sampler.coordinate()}}; };
      const Vec3 a = random(), b = random(), c = random();
      const auto rational = [&](int axis) {
        const int e = (axis + 1) % 3, f = (axis + 2) % 3;
        return ((Rational(b[e]) - a[e]) * (Rational(c[f]) - a[f]) - (Rational(b[f]) - a[f]) * (Rational(c[e]) - a[e])).sign();
      };
      for (int axis = 0; axis < 3; ++axis) CHECK(turn(a, b, c, axis) == rational(axis));
      const bool isFlat = rational(0) == 0 && rational(1) == 0 && rational(2) == 0;
      CHECK(collinear(a, b, c) == isFlat);
      CHECK(collinear(a, b, b));
      if (kind == Kind::lattice || kind == Kind::largeLattice || kind == Kind::smallLattice) CHECK(collinear(a, b, a + 2 * (b - a)));
    }
  }
}

TEST_CASE("validation arithmetic: residues are 0 where the exact numbers are", "[validate]") {
  CHECK((Residue(0.5) + Residue(0.25) == Residue(0.75)));
  CHECK_FALSE((Residue(0.1) + Residue(0.2) == Residue(0.3)));
  CHECK((Residue(-3) * Residue(5) + Residue(15)).isZero());
  CHECK((Residue(0x1p-1074) * Residue(0x1p1000) * Residue(0x1p74) == Residue(1)));
  CHECK_FALSE((Residue(1e300) * Residue(1e-300) == Residue(1)));
  CHECK_FALSE((Residue(4.1) == Residue(0.1)));  // as it would be for the prime 2^57 - 13
  for (const Kind kind : kKinds) {
    Sampler sampler(kind, 9);
    for (int i = 0; i < 300; ++i) {
      const double a = sampler.coordinate(), b = sampler.coordinate(), c = sampler.coordinate(), d = sampler.coordinate();
      const bool zero = ((Rational(a) - b) * (Rational(c) - d) - (Rational(b) - c) * (Rational(a) - d)).sign() == 0;
      const Residue x = a, y = b, z = c, w = d;
      CHECK(((x - y) * (z - w) - (y - z) * (x - w)).isZero() == zero);
      CHECK(((x + y) * (x - y) - x * x + y * y).isZero());
      CHECK((a == 0 || x * x.inverse() == Residue(1)));
    }
  }
}

TEST_CASE("validation arithmetic: distances", "[validate]") {
  const Vec3 a{{0, 0, 0}}, b{{4, 0, 0}}, c{{0, 4, 0}};
  CHECK(distanceToSegment({{2, 3, 0}}, a, b) == 3);
  CHECK(distanceToSegment({{7, 4, 0}}, a, b) == 5);
  CHECK(distanceToSegment({{3, 4, 0}}, a, a) == 5);
  CHECK(distanceToTriangle({{1, 1, -2}}, a, b, c) == 2);
  CHECK(distanceToTriangle({{-3, -4, 0}}, a, b, c) == 5);
  // However thin.
  CHECK(distanceToTriangle({{1, 1e-9, 1}}, a, b, {{2, 3e-9, 0}}) == Approx(1));
}

TEST_CASE("validation tallies: parts merged in order tell what the whole tells", "[validate]") {
  SECTION("violations are counted, the first is kept") {
    Tally whole("faces"), first("faces"), second("faces"), third("faces");
    whole.violate("face", 3, "is wrong"), whole.violate("face", 5, "is strange"), whole.violate("face", 9, "is wrong");
    second.violate("face", 3, "is wrong"), second.violate("face", 5, "is strange");
    third.violate("face", 9, "is wrong");
    first.merge(second), first.merge(third);
    for (const Tally* tally : {&whole, &first}) {
      const Check check = tally->finish();
      CHECK_FALSE(check.pass);
      CHECK(check.worst == 3);
      CHECK(check.element == 3);
      CHECK(check.message == "Face 3 is wrong. There are 3 violations in all.");
    }
  }
  SECTION("the largest deviation is kept, and of equal ones the first") {
    Tally first("area", 64), second("area", 64), third("area", 64);
    first.measure({100, 0.01}, "face", 1, "is off by {}");
    second.measure({200, 0.03}, "face", 2, "is off by {}");
    third.measure({200, 0.5}, "face", 3, "is off by {}");
    first.merge(second), first.merge(third);
    CHECK(first.finish().element == 2);
    CHECK(first.finish().worst == 200);
    CHECK(first.finish().message == "Face 2 is off by 3%.");
  }
  SECTION("what can't be computed stays") {
    Tally first("area", 64), second("area", 64);
    first.measure({std::nan(""), std::nan("")}, "face", 1, "is off by {}");
    second.measure({1e9, 1}, "face", 2, "is off by {}");
    first.merge(second);
    CHECK_FALSE(first.finish().pass);
    CHECK(first.finish().message == "Face 1 is off by an amount that can't be computed.");
  }
}

TEST_CASE("validation tallies: messages give amounts that people can read", "[validate]") {
  const auto message = [](double share) {
    Tally tally("area", 64);
    tally.measure({1e15, share}, "triangle", 12, "is off by {}");
    return tally.finish().message;
  };
  CHECK(message(127.77) == "Triangle 12 is off by more than 1000%.");
  CHECK(message(1) == "Triangle 12 is off by 100%.");
  CHECK(message(0.126) == "Triangle 12 is off by 13%.");
  CHECK(message(0.0996) == "Triangle 12 is off by 10%.");
  CHECK(message(0.05) == "Triangle 12 is off by 5%.");
  CHECK(message(0.0031) == "Triangle 12 is off by 0.31%.");
  CHECK(message(0.0003) == "Triangle 12 is off by 0.03%.");
  CHECK(message(0.00012) == "Triangle 12 is off by 0.012%.");
  CHECK(message(1e-9) == "Triangle 12 is off by less than 0.01%, more than rounding explains.");
}

TEST_CASE("validation arithmetic: numbers of any size", "[validate]") {
  const Exact huge = Exact(0x1p1000) * 0x1p1000, tiny = Exact(0x1p-1074) * 0x1p-1074;
  CHECK((huge + tiny - huge).sign() == 1);
  CHECK((huge - tiny - huge).sign() == -1);
  CHECK((huge * tiny - Exact(0x1p-148)).sign() == 0);
  CHECK((Exact(0.1) + 0.2 - 0.3).sign() == 1);
  CHECK((Exact(-7) * 3 + 21).sign() == 0);
  CHECK(Exact(-0.0).sign() == 0);
  for (const Kind kind : kKinds) {
    Sampler numbers(kind, 5);
    for (int i = 0; i < 300; ++i) {
      const double a = numbers.coordinate(), b = numbers.coordinate(), c = numbers.coordinate(), d = numbers.coordinate();
      const int expected = ((Rational(a) + b) * (Rational(c) - d) - Rational(a) * c + Rational(b) * d).sign();
      CHECK(((Exact(a) + b) * (Exact(c) - d) - Exact(a) * c + Exact(b) * d).sign() == expected);
    }
  }
}

TEST_CASE("validation passes: right cut-meshes pass each", "[validate]") {
  Fixture f = sphere();
  const Context context = f.context();
  const InputTopology topology = findTopology(context);
  const TriangleBins bins(context);
  const VertexChecks vertices = checkVertices(context, f.monitor);
  CHECK((vertices.vertices.pass && vertices.positions.pass));
  const FaceChecks faces = checkFaces(context, f.monitor);
  CHECK((faces.faces.pass && faces.planarity.pass && faces.orientation.pass && faces.halfFaces.pass && faces.isolation.pass));
  const GridCellChecks gridCells = checkGridCells(context, f.monitor);
  CHECK((gridCells.closedCells.pass && gridCells.facingFaces.pass && gridCells.conforming.pass && gridCells.crossings.pass));
  CHECK((gridCells.gridFaces.pass && gridCells.connected.pass && gridCells.distinctCells.pass && gridCells.partition.pass));
  CHECK((gridCells.cellVolume.pass && gridCells.gridCellVolume.pass && gridCells.gridFaceArea.pass));
  const SurfaceChecks surface = checkSurface(context, f.monitor);
  CHECK((surface.area.pass && surface.droppedTriangles.pass));
  const RegionChecks regions = checkRegions(context, bins);
  CHECK((regions.stencil.pass && regions.regions.pass));
  const WindingChecks winding = checkWinding(context, topology, bins, gridCells);
  CHECK((winding.windingNumber.pass && winding.inputVolume.pass));
  CHECK_FALSE((winding.windingNumber.skipped || winding.inputVolume.skipped));
}

TEST_CASE("validation passes: cut-cells are grouped by grid cell", "[validate]") {
  const Fixture f = sphere();
  const GridCellGroups groups = groupByGridCell(f.cutMesh);
  std::vector<uint32_t> seen;
  for (size_t g = 0; g < groups.count(); ++g) {
    CHECK_FALSE(groups[g].empty());
    for (const uint32_t c : groups[g]) {
      seen.push_back(c);
      CHECK(std::equal(&f.cutMesh.cellGridCell[3 * c], &f.cutMesh.cellGridCell[3 * c] + 3, &f.cutMesh.cellGridCell[3 * groups[g][0]]));
    }
  }
  CHECK(groups.count() == 32);  // of 64; the sphere reaches no edge of the box
  std::sort(seen.begin(), seen.end());
  for (uint32_t c = 0; c < seen.size(); ++c) CHECK(seen[c] == c);
  CHECK(seen.size() == f.cutMesh.cellCount());
}

TEST_CASE("validation passes: topology of the input", "[validate]") {
  const auto topologyOf = [](const Mesh& mesh) {
    const Fixture f(mesh, unitGrid(4));
    return findTopology(f.context());
  };
  const Mesh cube = shapes::cube(0.5, 1.25);
  SECTION("closed") {
    const InputTopology topology = topologyOf(cube);
    CHECK((topology.mayBeClosed && !topology.mayBeOpen));
  }
  SECTION("open") {
    Mesh open = cube;
    open.triangles.resize(open.triangles.size() - 3);
    const InputTopology topology = topologyOf(open);
    CHECK((!topology.mayBeClosed && topology.mayBeOpen));
  }
  SECTION("closed but for a triangle that is there twice") {
    Mesh twice = cube;
    twice.triangles.insert(twice.triangles.end(), twice.triangles.begin(), twice.triangles.begin() + 3);
    const InputTopology topology = topologyOf(twice);
    CHECK((!topology.mayBeClosed && topology.mayBeOpen));
  }
}

TEST_CASE("validation passes: winding numbers of the input at points", "[validate]") {
  const Fixture f(shapes::merged({shapes::cube(0.5, 3.5), shapes::cube(1.25, 2.25)}), unitGrid(4));
  const Context context = f.context();
  const TriangleBins bins(context);
  const double scale = context.planes()[0][1];
  const auto windingAt = [&](double x, double y, double z) { return bins.winding(scale * Vec3{{x, y, z}}, [](uint32_t) { return true; }); };
  CHECK(windingAt(0.1, 0.3, 0.2) == 0);
  CHECK(windingAt(0.7, 0.9, 0.8) == 1);
  CHECK(windingAt(1.5, 1.7, 1.6) == 2);
  CHECK(windingAt(3.1, 1.7, 1.6) == 1);
  CHECK_FALSE(windingAt(1, 1, 0.5).has_value());  // on a diagonal
}

TEST_CASE("validation passes: each sees what is its own", "[validate]") {
  Fixture f = sphere();
  SECTION("vertices: one moved off its plane") {
    const auto made = std::find(f.cutMesh.vertexTriVertex.begin(), f.cutMesh.vertexTriVertex.end(), -1);
    const size_t v = size_t(made - f.cutMesh.vertexTriVertex.begin());
    for (size_t d = 0; d < 3; ++d) f.cutMesh.positions[3 * v + d] += 1e-6;
    const VertexChecks checks = checkVertices(f.context(), f.monitor);
    CHECK(checks.vertices.pass);
    CHECK_FALSE(checks.positions.pass);
    CHECK(checks.positions.element == int64_t(v));
  }
  SECTION("faces: a half-face that nobody lists") {
    const uint32_t face = f.cutMesh.cellHalfFaces[0] / 2;
    f.cutMesh.cellHalfFaces[0] = f.cutMesh.cellHalfFaces[1];
    const FaceChecks checks = checkFaces(f.context(), f.monitor);
    CHECK_FALSE(checks.halfFaces.pass);
    CHECK(checks.planarity.pass);
    CHECK(face < f.cutMesh.faceCount());
  }
  SECTION("grid cells: the volumes are those of the cells, and samples lie in them") {
    const Context context = f.context();
    const GridCellChecks checks = checkGridCells(context, f.monitor);
    const double scale = context.planes()[0][1];
    CHECK(total(checks.cellVolumes) / std::pow(scale, 3) == Approx(32));
    CHECK(checks.samples.size() > 100);
    for (const Sample& sample : checks.samples) {
      REQUIRE(std::string(sample.kind) == "cell");
      for (int d = 0; d < 3; ++d) {
        const int32_t at = f.cutMesh.cellGridCell[3 * size_t(sample.element) + size_t(d)];
        CHECK(sample.position[d] >= context.planes()[size_t(d)][size_t(at)]);
        CHECK(sample.position[d] <= context.planes()[size_t(d)][size_t(at) + 1]);
      }
    }
  }
  SECTION("surface: a face that another triangle claims, too") {
    const auto face = std::find_if(f.cutMesh.faceTriangle.begin(), f.cutMesh.faceTriangle.end(), [](int32_t t) { return t >= 0; });
    const size_t place = f.cutMesh.faceParentOffsets[size_t(face - f.cutMesh.faceTriangle.begin())];
    f.cutMesh.faceParents[place] ^= 1;
    const SurfaceChecks checks = checkSurface(f.context(), f.monitor);
    CHECK_FALSE(checks.area.pass);
  }
  SECTION("regions: one that is split") {
    f.cutMesh.cellRegion[0] = f.cutMesh.cellRegion[0] == 0 ? 1 : 0;
    const Context context = f.context();
    const RegionChecks checks = checkRegions(context, TriangleBins(context));
    CHECK(checks.stencil.pass);
    CHECK_FALSE(checks.regions.pass);
  }
  SECTION("winding: nothing but what it is given") {
    const Context context = f.context();
    const InputTopology topology = findTopology(context);
    const TriangleBins bins(context);
    GridCellChecks gridCells = checkGridCells(context, f.monitor);
    for (double& volume : gridCells.cellVolumes) volume *= 1.5;
    gridCells.samples[0].region ^= 1;
    const WindingChecks checks = checkWinding(context, topology, bins, gridCells);
    CHECK_FALSE(checks.inputVolume.pass);
    CHECK(checks.windingNumber.worst == 1);
    CHECK(checks.windingNumber.element == gridCells.samples[0].element);
  }
}
