// The library's made meshes: closed, outward, of the volume they should have.
#include <cmath>

#include "catch.h"
#include "mandoline/shapes.h"
#include "refusal.h"
#include "shapes.h"

using mandoline::Mesh;

namespace {

void requireClosedSolid(const Mesh& mesh, double volume) {
  const mandoline::CutResult result = mandoline::cut(mesh, mandoline::Grid::around(mesh, 8));
  INFO(result.error.message);
  REQUIRE(result);
  REQUIRE(result.mesh.hasWinding);
  REQUIRE(result.mesh.regionCount == 2);
  REQUIRE(result.mesh.droppedTriangles.empty());
  REQUIRE(shapes::signedVolume(mesh) == Approx(volume).epsilon(0.02));
}

constexpr double kPi = 3.14159265358979323846;

}  // namespace

TEST_CASE("Made box", "[shapes]") {
  const Mesh box = mandoline::makeBox({-1, 0, 2}, {1, 3, 4});
  REQUIRE(box.triangleCount() == 12);
  requireClosedSolid(box, 12);
}

TEST_CASE("Made sphere", "[shapes]") {
  const Mesh sphere = mandoline::makeSphere({1, 2, 3}, 2, 3);
  REQUIRE(sphere.triangleCount() == 20 * 64);
  requireClosedSolid(sphere, 4 / 3. * kPi * 8);
}

TEST_CASE("Made torus", "[shapes]") {
  const Mesh torus = mandoline::makeTorus(2, 0.5, 60, 30);
  REQUIRE(torus.triangleCount() == 2 * 60 * 30);
  requireClosedSolid(torus, 2 * kPi * kPi * 2 * 0.25);
}

TEST_CASE("Made tubes of fewer than three rings or corners are refused", "[shapes]") {
  for (const int few : {2, 1, 0, -1}) {
    CAPTURE(few);
    const std::pair expected(mandoline::Status::badArgument, int64_t(-1));
    CHECK(refusal([&] { mandoline::makeTorus(2, 0.5, few, 3); }) == expected);
    CHECK(refusal([&] { mandoline::makeTorus(2, 0.5, 3, few); }) == expected);
    CHECK(refusal([&] { mandoline::makeTorusKnot(0.4, few, 3); }) == expected);
    CHECK(refusal([&] { mandoline::makeTorusKnot(0.4, 3, few); }) == expected);
  }
  CHECK(mandoline::makeTorus(2, 0.5, 3, 3).triangleCount() == 18);
}

TEST_CASE("Made torus knot", "[shapes]") {
  const Mesh knot = mandoline::makeTorusKnot();
  REQUIRE(knot.triangleCount() == 2 * 240 * 16);
  double curve = 0;  // its length, so that the volume is that times the tube's section (Pappus)
  const Mesh thin = mandoline::makeTorusKnot(1e-6, 2000, 3);
  for (size_t i = 0; i < 2000; ++i) {
    double square = 0;
    for (size_t d = 0; d < 3; ++d) {
      const double step = thin.positions[9 * ((i + 1) % 2000) + d] - thin.positions[9 * i + d];
      square += step * step;
    }
    curve += std::sqrt(square);
  }
  const double section = 16 / 2. * std::sin(2 * kPi / 16) * 0.16;
  requireClosedSolid(knot, curve * section);
}
