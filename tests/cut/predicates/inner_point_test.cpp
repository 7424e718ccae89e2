// Predicate P7 against a direct evaluation of its definition in rational arithmetic.
#include "cut/predicates/inner_point.h"

#include "catch.h"
#include "exact_cut.h"

using namespace mandoline;
using namespace mandoline::detail;
using namespace exact_vectors;

namespace {

/// Weights for the mean of three corners.
std::array<double, 3> randomWeights(Sampler& sampler) {
  const uint64_t attempt = sampler.oneIn(2) ? 0 : sampler.below(64);
  if (attempt == 0) return {1, 1, 2};
  return {1.0 + double(attempt * 7 % 11), 1.0 + double(attempt * 5 % 13), 1.0 + double(attempt * 3 % 17)};
}

Vector meanOf(const std::array<Vector, 3>& corners, const std::array<double, 3>& weights) {
  Vector mean;
  for (int i = 0; i < 3; ++i) mean = mean + Rational(weights[i]) * corners[i];
  return (Rational(1) / Rational(weights[0] + weights[1] + weights[2])) * mean;
}

/// An input whose triangle 0 has a point inside, with what the tests need to aim others at that point.
struct Shot {
  Prepared mesh;
  Input input;
  CutVertices vertices;
  InnerPoint point;
  Vector truth;
  Point near;  // the point, rounded

  Shot(Sampler& sampler, const std::array<Point, 3>& corners) {
    input.mesh = &mesh;
    vertices.input = &input;
    add(corners);
    point = {{VertexId{0}, VertexId{1}, VertexId{2}}, randomWeights(sampler)};
    truth = meanOf(exact(corners), point.weights);
    const double sum = point.weights[0] + point.weights[1] + point.weights[2];
    for (int d = 0; d < 3; ++d) {
      near[d] = 0;
      for (int i = 0; i < 3; ++i) near[d] += point.weights[i] / sum * corners[i][d];
      near[d] = Sampler::allowed(near[d]);
    }
  }
  Shot(const Shot&) = delete;

  TriangleId add(const std::array<Point, 3>& corners) {
    const uint32_t first = mesh.triVertices;
    mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triVertices = first + 3;
    vertices.firstOnEdge = {mesh.triVertices};
    return {uint32_t(mesh.triangles.size() - 1)};
  }
};

std::array<Point, 3> randomTriangle(Sampler& sampler) { return {sampler.point(), sampler.point(), sampler.point()}; }

/// A triangle that a line along the axis through the point `near` meets: near another point on that line, in its inside or close to a side.
std::array<Point, 3> triangleThrough(Sampler& sampler, Point near, int axis, bool exactlyThere) {
  if (!exactlyThere) near[axis] = sampler.coordinate();
  const Point a = sampler.point(), b = sampler.point();
  const auto share = [&] { return sampler.oneIn(3) ? -sampler.unit() : sampler.oneIn(3) ? 0 : -double(sampler.below(9)) / 8; };
  const double s = share(), t = share();
  return {a, b, sampler.nudged(Sampler::combined(near, a, b, s, t))};
}

/// Calls test(shot, triangle, axis, predicates) with triangles at random and aimed at the point; `exact`: whether some signs need
/// exactness.
template <class Test>
void forShots(const Test& test, bool exact = true) {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind);
    Predicates predicates;
    for (int repeat = 0; repeat < 1500; ++repeat) {
      Shot shot(sampler, randomTriangle(sampler));
      const int axis = int(sampler.below(3));
      const std::array<Point, 3> t =
          sampler.oneIn(4) ? randomTriangle(sampler) : triangleThrough(sampler, shot.near, axis, sampler.oneIn(2));
      test(sampler, shot, t, axis, predicates);
    }
    CHECK((!exact || predicates.fallbacks > 5));
  }
}

}  // namespace

TEST_CASE("P7: where a point lies and its line meets a triangle's plane, in doubles, and where the plane's normal points", "[predicates]") {
  int normalCounts[3] = {}, heights = 0;
  const auto holds = [](const Bounded& bounded, const Rational& truth) {
    if (std::isinf(bounded.error)) return true;
    const Rational off = Rational(bounded.value) - truth, most = Rational(bounded.error) * Rational(1 + 0x1p-30);
    return (off - most).sign() <= 0 && (off + most).sign() >= 0;
  };
  forShots(
      [&](Sampler&, Shot& shot, const std::array<Point, 3>& t, int axis, Predicates& predicates) {
        const auto corners = exact(t);
        const Vector normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        const TriangleId triangle = shot.add(t);
        const auto point = approximate(shot.vertices, shot.point, predicates);
        for (int d = 0; d < 3; ++d) REQUIRE(holds(point[size_t(d)], shot.truth[d]));
        if (normal[axis].sign() != 0) {
          const Bounded height = approximateHeight(shot.vertices, triangle, shot.point, axis, predicates);
          REQUIRE(holds(height, shot.truth[axis] - dot(normal, shot.truth - corners[0]) / normal[axis]));
          heights += !std::isinf(height.error);
        }
        REQUIRE(normalSign(*shot.input.mesh, triangle, axis, predicates) == normal[axis].sign());
        ++normalCounts[normal[axis].sign() + 1];
      },
      false);
  CHECK(heights > 1000);
  for (const int count : normalCounts) CHECK(count > 50);
}

TEST_CASE("P7: the order in which a ray meets two triangles", "[predicates]") {
  int counts[3] = {};
  forShots([&](Sampler& sampler, Shot& shot, const std::array<Point, 3>& t, int axis, Predicates& predicates) {
    const auto corners = exact(t);
    Vector meet = shot.truth, other = shot.truth;
    if (!meetLine(corners, axis, meet)) return;
    std::array<Point, 3> u = randomTriangle(sampler);
    if (!sampler.oneIn(4)) {  // through the place where the first one is met
      const Point &a = t[0], &b = t[1], &c = t[2];
      const double x = b[(axis + 1) % 3] - a[(axis + 1) % 3], y = b[(axis + 2) % 3] - a[(axis + 2) % 3];
      u = sampler.oneIn(2) ? triangleThrough(sampler, shot.near, axis, true)
                           : std::array<Point, 3>{sampler.nudged(Sampler::combined(a, b, c, 0.25, 0.25)), b,
                                                  x * y == 0 ? c : sampler.nudged(sampler.onPlane(a, b, c))};
    }
    if (!meetLine(exact(u), axis, other)) return;
    const int expected = order(meet[axis], other[axis]);
    const TriangleId first = shot.add(t), second = shot.add(u);
    REQUIRE(compareHeights(shot.vertices, {first, second}, shot.point, axis, predicates) == expected);
    REQUIRE(compareHeights(shot.vertices, {second, first}, shot.point, axis, predicates) == -expected);
    ++counts[expected + 1];
  });
  for (const int count : counts) CHECK(count > 100);
}

TEST_CASE("P7: where a point lies beside the vertices and edges of a grid-face", "[predicates]") {
  int aboveCounts[3] = {}, sideCounts[3] = {};
  Predicates predicates;
  forCuts(10, [&](const Cut& cut) {
    Sampler sampler(Kind::lattice);
    std::vector<VertexId> ids;
    for (const VertexId v : cut.used) {
      if (cut.inGrid(v)) ids.push_back(v);
    }
    const auto any = [&](const std::vector<VertexId>& of) { return of[sampler.below(of.size())]; };
    const auto groups = alignedVertices(cut);
    for (int i = 0; i < 300 && !ids.empty(); ++i) {
      const auto& group = groups[sampler.below(groups.size())];
      VertexId u = any(ids), v = any(ids);
      if (sampler.oneIn(2)) u = any(group), v = any(group);
      if (!cut.inGrid(u) || !cut.inGrid(v)) continue;
      const auto corner = [&] { return sampler.oneIn(3) ? any(ids) : any({u, v}); };
      const InnerPoint point{{any(group), corner(), corner()}, randomWeights(sampler)};
      if (!cut.inGrid(point.corners[0])) continue;
      const Vector truth =
          meanOf({cut.points[point.corners[0]], cut.points[point.corners[1]], cut.points[point.corners[2]]}, point.weights);
      for (int axis = 0; axis < 3; ++axis) {
        const int q = (axis + 2) % 3, above = order(cut.points[v][q], truth[q]);
        REQUIRE(isAbove(cut.vertices, v, point, axis, predicates) == (above > 0));
        ++aboveCounts[above + 1];
        const int side = area(cut.points[u], cut.points[v], truth, axis).sign();
        REQUIRE(sideOfLine(cut.vertices, {u, v}, point, axis, predicates) == side);
        sideCounts[side + 1] += u != v;
      }
    }
  });
  for (const int count : aboveCounts) CHECK(count > 100);
  for (const int count : sideCounts) CHECK(count > 100);
  CHECK(predicates.fallbacks > 100);
}
