// Predicates P4 and P5 about a vertex of a grid-face, against a direct evaluation of their definitions in rational arithmetic.
#include "cut/stages/planar_graph.h"

#include "catch.h"
#include "exact_cut.h"

using namespace mandoline;
using namespace mandoline::detail;
using namespace exact_vectors;

namespace {

/// Points close to the plane z = 0: a centre, tips around it, and others between. Each is a tri-vertex or a crossing of a tri-edge.
struct WheelSoup : Soup {
  std::vector<bool> isCrossing;

  explicit WheelSoup(Sampler& sampler, bool onLattice) {
    grid = Grid::rectilinear({{{-64, 64}, {-64, 64}, {-64, 0, 64}}});
    std::vector<Point> points = {sampler.point()};
    const Point centre = points[0];
    const auto any = [&] { return points[sampler.below(points.size())]; };
    for (const size_t tips = 3 + sampler.below(5); points.size() <= tips;)
      points.push_back(sampler.oneIn(2) ? sampler.point() : sampler.nudged(sampler.onLine(centre, any())));
    for (int i = 0; i < 12; ++i)
      points.push_back(sampler.nudged(Sampler::combined(centre, any(), any(), sampler.unit(), sampler.oneIn(3) ? 0 : sampler.unit() / 2)));
    for (const Point& p : points) {
      isCrossing.push_back(sampler.oneIn(2));
      const double dx = double(sampler.below(9)) - 4, dy = double(sampler.below(9)) - 4;
      const double below = onLattice ? 1 : 1 + sampler.unit(), above = !isCrossing.back() ? 0 : onLattice ? 1 : 1 + sampler.unit();
      add({p[0] + above * dx, p[1] + above * dy, above});
      add({p[0] - below * dx, p[1] - below * dy, -below});
      add({p[0] + 31, p[1] + 20, -20});  // never in line with the other two
    }
    finish();
  }
};

/// A planar graph of such points, and how they truly lie.
struct Wheel {
  Cut cut;
  PlanarGraph graph;
  std::vector<VertexId> ids;    // per point of the soup
  std::vector<uint32_t> tips;   // points, counter-clockwise
  bool tied = false;            // whether two tips lie in one direction
  std::vector<uint32_t> inner;  // two points in the wedge from a tip to the next, or less
  size_t wedge = 0;             // that tip

  Wheel(const WheelSoup& soup, size_t tipCount, Sampler& sampler) : cut(soup) {
    for (uint32_t i = 0; i < soup.isCrossing.size(); ++i) {
      const VertexId a = cut.input.verticesOf({i})[0], b = cut.input.verticesOf({i})[1];
      const std::array<VertexId, 2> ends = {std::min(a, b), std::max(a, b)};
      const auto edge = std::find(cut.edges.ends.begin(), cut.edges.ends.end(), ends);
      REQUIRE(edge != cut.edges.ends.end());
      ids.push_back(soup.isCrossing[i] ? *cut.vertices.crossings({uint32_t(edge - cut.edges.ends.begin())}).begin() : a);
    }
    for (uint32_t i = 1; i <= tipCount; ++i) tips.push_back(i);
    const Angles angles(point(0), point(0) + Vector{Rational(0), Rational(0), Rational(1)}, point(1));
    const auto isBefore = [&](uint32_t i, uint32_t j) { return Angles::compare(angles.of(point(i)), angles.of(point(j))) < 0; };
    std::sort(tips.begin(), tips.end(), isBefore);
    for (size_t i = 1; i < tips.size(); ++i) tied |= !isBefore(tips[i - 1], tips[i]);
    wedge = sampler.below(tips.size());
    for (uint32_t i = uint32_t(tipCount) + 1; i < ids.size() && inner.size() < 2; ++i) {
      if (turn(0, tips[wedge], i) > 0 && turn(tips[wedge], next(wedge), i) > 0 && turn(next(wedge), 0, i) > 0) {
        if (inner.empty() || !(point(i) - point(inner[0]) == Vector())) inner.push_back(i);
      }
    }
    std::vector<VertexId> outline;
    for (const Slab& slab : {Slab{0, 0, 2}, Slab{2, 0, 2}, Slab{2, 2, 2}, Slab{0, 2, 2}}) {
      outline.push_back({uint32_t(cut.vertices.size())});
      cut.vertices.add(slab, CutVertices::kNoTriangle);
    }
    graph.begin(cut.vertices, 2);
    graph.setOutline(outline);
    for (size_t i = 0; i < tips.size(); ++i) {
      graph.addEdge(ids[0], ids[tips[i]]);
      if (isConvex(i)) graph.addEdge(ids[tips[i]], ids[next(i)]);
    }
    if (inner.size() == 2) graph.addEdge(ids[inner[0]], ids[inner[1]]);
  }

  const Vector& point(uint32_t i) const { return cut.points[ids[i]]; }
  int turn(uint32_t i, uint32_t j, uint32_t k) const { return area(point(i), point(j), point(k), 2).sign(); }
  uint32_t next(size_t tip) const { return tips[tip + 1 < tips.size() ? tip + 1 : 0]; }
  /// Whether the wedge from a tip to the next is less than half a turn, so that a triangle fits in.
  bool isConvex(size_t tip) const { return turn(0, tips[tip], next(tip)) > 0; }
  PlanarGraph::HalfEdge find(uint32_t from, uint32_t to) const { return graph.find(ids[from], ids[to]).value(); }
};

}  // namespace

TEST_CASE("P4, P5: edges around a vertex of a grid-face, and what lies in the faces between them", "[predicates]") {
  size_t wedges = 0, failures = 0, nested = 0;
  Predicates predicates;
  for (const Kind kind : {Kind::lattice, Kind::random, Kind::sparse}) {
    Sampler sampler(kind);
    for (int repeat = 0; repeat < 300; ++repeat) {
      const WheelSoup soup(sampler, kind == Kind::lattice);
      Wheel wheel(soup, soup.isCrossing.size() - 13, sampler);
      const auto isCentre = [&](uint32_t tip) { return (wheel.point(tip) - wheel.point(0)) == Vector(); };
      if (std::any_of(wheel.tips.begin(), wheel.tips.end(), isCentre)) continue;
      if (wheel.tied) {
        CHECK_THROWS_AS(wheel.graph.build(predicates), Failure);
        ++failures;
        continue;
      }
      const PlanarGraph& graph = wheel.graph;
      wheel.graph.build(predicates);
      for (size_t i = 0; i < wheel.tips.size(); ++i) {
        if (!wheel.isConvex(i)) continue;
        const auto out = wheel.find(0, wheel.tips[i]), along = graph.next(out), back = graph.next(along);
        REQUIRE(along == wheel.find(wheel.tips[i], wheel.next(i)));
        REQUIRE(back == wheel.find(wheel.next(i), 0));
        REQUIRE(graph.next(back) == out);
        REQUIRE(graph.face(along.twin()) == graph.face({0}));
        ++wedges;
      }
      if (wheel.inner.size() < 2) continue;
      REQUIRE(graph.face(wheel.find(wheel.inner[0], wheel.inner[1])) == graph.face(wheel.find(0, wheel.tips[wheel.wedge])));
      ++nested;
    }
  }
  CHECK(wedges > 1000);
  CHECK(failures > 100);
  CHECK(nested > 100);
  CHECK(predicates.fallbacks > 100);
}
