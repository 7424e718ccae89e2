// The validator's bounds decide only what they prove: without them the exact numbers decide the same.
#include "operators/validate/spots.h"

#include <algorithm>
#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "rational.h"
#include "shapes.h"

using namespace mandoline;
using namespace mandoline::validation;

namespace {

/// The same point, whose bounds leave all open: so finer ones decide.
Spot withoutPlace(const Spot& spot) {
  Spot other = spot;
  other.place = {Fine::unknown(), Fine::unknown(), Fine::unknown()};
  return other;
}

/// The same point, of which only exact numbers know where it is.
Spot withoutBounds(const Spot& spot) {
  Spot exact = withoutPlace(spot);
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

namespace {

/// The same number in every way.
struct Numbers {
  Rational exact;
  Fine fine;
  Bounded bounded;
};

Numbers ofDouble(double x) { return {x, x, {x, 0}}; }

/// Whether the exact number is within the bound. What overflows has none.
bool holds(const Bounded& bounded, const Rational& exact) {
  if (!std::isfinite(bounded.value) || !std::isfinite(bounded.error)) return bounded.sign() == 0;
  return abs(exact - bounded.value) <= Rational(bounded.error) * kOfBounds;
}

/// The same with all digits of a sum of two doubles.
bool holds(const Fine& fine, const Rational& exact) {
  const double high = fine.bounded().value;
  return std::isfinite(high) ? holds(Fine::difference(fine, high), exact - high) : fine.bounded().sign() == 0;
}

}  // namespace

TEST_CASE("spots: bounds of numbers hold the exact ones", "[validate]") {
  Random random(5);
  const auto any = [&](size_t count) { return size_t(random.next() % count); };
  // Small whole numbers, doubles of all digits, neighbours of 1, and far below the range that is scaled to.
  const auto number = [&] {
    const double x = 1 + double(random.next() >> 12) * 0x1p-52, small = double(any(7)) - 3;
    const double kinds[] = {small, any(2) ? x : -x, 1 + small * 0x1p-52, std::ldexp(x, int(any(200)) - 80),
                            std::ldexp(x, -500 - int(any(40)))};
    return kinds[any(5)];
  };
  for (int i = 0; i < 1500; ++i) {
    std::vector<Numbers> chain = {ofDouble(number()), ofDouble(number()), ofDouble(number())};
    for (int step = 0; step < 5; ++step) {
      const Numbers a = chain[any(chain.size())], b = chain[any(chain.size())];
      CHECK(holds(Fine::difference(a.fine, b.fine), a.exact - b.exact));
      if (b.exact.sign() != 0) CHECK(holds(quotient(a.fine, b.fine), a.exact / b.exact));
      if (any(3) == 0) {
        chain.push_back({a.exact + b.exact, a.fine + b.fine, a.bounded + b.bounded});
      } else if (any(2) == 0) {
        chain.push_back({a.exact - b.exact, a.fine - b.fine, a.bounded - b.bounded});
      } else {
        chain.push_back({a.exact * b.exact, a.fine * b.fine, a.bounded * b.bounded});
      }
      CHECK(holds(chain.back().fine, chain.back().exact));
      CHECK(holds(chain.back().bounded, chain.back().exact));
      if (chain.back().fine.isZero()) CHECK(chain.back().exact.sign() == 0);
    }
  }
}

TEST_CASE("spots: exact numbers are rounded within their bounds", "[validate]") {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    Exact exact = 0.0;
    Rational same = 0.0;
    for (int step = 0; step < 4; ++step) {  // more terms than are kept
      const double x = random.between(-1, 1), y = std::ldexp(random.between(-1, 1), -int(random.next() % 150));
      exact = exact * Exact(x) + Exact(y), same = same * x + y;
    }
    const int power = exact.end();
    CHECK(holds(Fine::of(exact, power), same * std::ldexp(1.0, -24 * power)));
  }
  CHECK(Fine::of(Exact(0.0), 0).isZero());
  CHECK_FALSE(Fine::of(Exact(0x1p-1000), 20).isZero());  // underflows
}

TEST_CASE("spots: what is left open", "[validate]") {
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
    const Spot e = meet(x, a, b, plane), e0 = withoutBounds(e);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(compare(x, a, e, axis) == compare(x, a0, e0, axis));
      CHECK(turn(x, {&a, &b, &e}, axis) == 0);
      CHECK(turn(x, {&a0, &b0, &e0}, axis) == 0);
      CHECK(turn(x, {&e, &d, &a}, axis) == turn(x, {&e0, &d0, &a0}, axis));
    }
  }
  CHECK(zeros > 0);
}

TEST_CASE("spots: finer bounds give the sides, turns and orders of exact numbers, and leave few open", "[validate]") {
  const Spindle spindle;
  const Context& x = spindle.context;
  Random random(7);
  const auto any = [&](size_t count) { return size_t(random.next() % count); };
  const auto made = [&] { return spotOf(x, spindle.cutMesh.madeVertices[any(spindle.cutMesh.madeVertices.size())]); };
  int exact = 0, met = 0;
  for (int i = 0; i < 1000; ++i) {
    const Spot a = withoutPlace(made()), b = withoutPlace(made()), d = withoutPlace(made());
    const Spot a0 = withoutBounds(a), b0 = withoutBounds(b), d0 = withoutBounds(d);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(compare(x, a, b, axis) == compare(x, a0, b0, axis));
      CHECK(turn(x, {&a, &b, &d}, axis) == turn(x, {&a0, &b0, &d0}, axis));
    }
    const size_t face = any(spindle.cutMesh.faceCount());
    const int32_t t = spindle.cutMesh.faceTriangle[face];
    if (t < 0 || x.inPlane(a.vertex, size_t(t)) || x.inPlane(b.vertex, size_t(t))) continue;
    const Spot corner = spotOf(x, spindle.cutMesh.loopVertices[spindle.cutMesh.loopOffsets[spindle.cutMesh.faceLoopOffsets[face]]]);
    const FinePlane plane = finePlane(x, size_t(t), corner);
    REQUIRE(plane.holdsOrigin);
    const int above = sideOf(x, plane, a), below = sideOf(x, plane, b);
    exact += plane.exact.has_value();
    CHECK(above == sideOf(x, plane, a0));
    CHECK(below == sideOf(x, plane, b0));
    if (above == below) continue;
    const Spot e = withoutPlace(meet(x, a, b, plane)), e0 = withoutBounds(e);
    ++met;
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(compare(x, d, e, axis) == compare(x, d0, e0, axis));
      CHECK(turn(x, {&e, &d, &a}, axis) == turn(x, {&e0, &d0, &a0}, axis));
    }
  }
  CHECK(exact < 50);
  CHECK(met > 20);
}

TEST_CASE("spots: a spindle torus is as right as it was cut", "[validate]") {
  const Spindle spindle;
  CHECK(validate(spindle.mesh, spindle.cutMesh).pass);
}

TEST_CASE("spots: a cut-vertex may name a tri-vertex that isn't finite", "[validate]") {
  Mesh mesh = shapes::torus({1.53, 1.47, 1.5}, 0.5, 0.75, 12, 12);
  const int32_t extra = int32_t(mesh.vertexCount());
  mesh.positions.insert(mesh.positions.end(), {NAN, INFINITY, 0});  // which no triangle has
  CutMesh wrong = cut(mesh, Grid::around(mesh, 3)).mesh;
  REQUIRE(validate(mesh, wrong).pass);
  const size_t v = size_t(std::find(wrong.vertexTriVertex.begin(), wrong.vertexTriVertex.end(), 5) - wrong.vertexTriVertex.begin());
  REQUIRE(v < wrong.vertexCount());
  wrong.vertexTriVertex[v] = wrong.vertexParents[2 * v] = wrong.vertexParents[2 * v + 1] = extra;
  CHECK_FALSE(validate(mesh, wrong).pass);
}
