// The validator's bounds decide only what they prove: without them the exact numbers decide the same.
#include "operators/validate/spots.h"

#include "catch.h"
#include "checked_cut.h"
#include "rational.h"
#include "samples.h"
#include "shapes.h"

using namespace mandoline;
using namespace mandoline::validation;

namespace {

/// The same point, of which only exact numbers know where it is.
Spot withoutBounds(const Spot& spot) {
  Spot exact = spot;
  exact.place = {Fine::unknown(), Fine::unknown(), Fine::unknown()};
  exact.w = Residue();
  return exact;
}

/// A spindle torus: around its axis triangles cross others nearly in one point, and nearly in their own planes.
struct Spindle {
  Mesh mesh = shapes::torus({1.53, 1.47, 1.5}, 0.5, 0.75, 12, 12);
  MeshView view{mesh};
  CutMesh cutMesh = cut(mesh, Grid::around(mesh, 5)).mesh;
  Context context{view, cutMesh};
};

}  // namespace

TEST_CASE("spots: bounds of numbers hold the exact ones", "[validate]") {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind, 11);
    for (int i = 0; i < 300; ++i) {
      const double a = sampler.coordinate(), b = sampler.coordinate(), c = sampler.coordinate(), d = sampler.coordinate();
      const int expected = ((Rational(a) - b) * (Rational(c) - d) - (Rational(b) - c) * (Rational(a) - d)).sign();
      const Fine x = a, y = b, z = c, w = d;
      const int fine = ((x - y) * (z - w) - (y - z) * (x - w)).bounded().sign();
      const auto apart = &Fine::difference;
      const int bounded = (apart(x, y) * apart(z, w) - apart(y, z) * apart(x, w)).sign();
      CHECK((fine == 0 || fine == expected));
      CHECK((bounded == 0 || bounded == expected));
      if (expected == 0) CHECK((x - x).isZero());
    }
  }
  CHECK((Fine(0x1p1000) * Fine(0x1p1000)).bounded().sign() == 0);
  CHECK((Fine(0x1p-600) * Fine(0x1p-600)).bounded().sign() == 0);
  CHECK(quotient(Fine(1), Fine(1) - Fine(1)).bounded().sign() == 0);
  CHECK((quotient(Fine(1), Fine(3)) * Fine(3) - Fine(1)).bounded().sign() == 0);
  CHECK((Fine(1) + Fine(0x1p-80) - Fine(1)).bounded().sign() == 1);
}

TEST_CASE("spots: exact numbers alone give the same sides, turns and orders", "[validate]") {
  const Spindle spindle;
  const Context& x = spindle.context;
  REQUIRE(spindle.cutMesh.madeVertices.size() > 50);
  Random random(3);
  const auto any = [&](size_t count) { return size_t(random.next() % count); };
  const auto made = [&] { return spotOf(x, spindle.cutMesh.madeVertices[any(spindle.cutMesh.madeVertices.size())]); };
  int zeros = 0;
  for (int i = 0; i < 400; ++i) {
    const Spot a = made(), b = made(), c = middle(a, b), d = i % 2 == 0 ? made() : c;
    const Spot a0 = withoutBounds(a), b0 = withoutBounds(b), d0 = withoutBounds(d);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(compare(x, a, b, axis) == compare(x, a0, b0, axis));
      CHECK(compare(x, c, c, axis) == 0);
      const int side = turn(x, {&a, &b, &d}, axis);
      CHECK(side == turn(x, {&a0, &b0, &d0}, axis));
      zeros += side == 0;
    }
    const size_t t = any(spindle.mesh.triangleCount());
    if (x.inPlane(a.vertex, t) || x.inPlane(b.vertex, t)) continue;
    const FinePlane plane = finePlane(x, t, b), plane0 = finePlane(x, t, b0);
    const int above = sideOf(x, plane, a), below = sideOf(x, plane, b);
    CHECK(above == sideOf(x, plane0, a0));
    CHECK(below == sideOf(x, plane0, b0));
    if (above == below) continue;
    const Spot e = meet(x, a, b, t), e0 = withoutBounds(e);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(compare(x, a, e, axis) == compare(x, a0, e0, axis));
      CHECK(turn(x, {&a, &b, &e}, axis) == 0);
      CHECK(turn(x, {&a0, &b0, &e0}, axis) == 0);
      CHECK(turn(x, {&e, &d, &a}, axis) == turn(x, {&e0, &d0, &a0}, axis));
    }
  }
  CHECK(zeros > 0);
}

TEST_CASE("spots: a spindle torus is as right as it was cut", "[validate]") {
  const Spindle spindle;
  CHECK(validate(spindle.mesh, spindle.cutMesh).pass);
  // A made vertex between two others that share its parents is another point of the same triangles.
  CutMesh wrong = spindle.cutMesh;
  for (size_t i = 0; i + 1 < wrong.madeVertices.size(); ++i) {
    if (wrong.madeVertexKinds[i] != wrong.madeVertexKinds[i + 1]) continue;
    for (size_t k = 0; k < 4; ++k) std::swap(wrong.madeVertexParents[4 * i + k], wrong.madeVertexParents[4 * i + 4 + k]);
    break;
  }
  CHECK_FALSE(validate(spindle.mesh, wrong).pass);
}
