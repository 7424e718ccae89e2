// Every predicate P1 to P7 against a direct evaluation of its definition in rational arithmetic: on random input, on input rounded onto
// grid lines, planes and each other, and on lattices, where ties are exact and common.
#include <memory>

#include "catch.h"
#include "cut/predicates/inner_point.h"
#include "cut/predicates/radial_order.h"
#include "cut/stages/planar_graph.h"
#include "rational.h"
#include "samples.h"
#include "staged_cut.h"
#include "vectors.h"

using namespace mandoline;
using namespace mandoline::detail;
using namespace vectors;

namespace {

using Vector = std::array<Rational, 3>;

Vector exact(const Point& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

/// Twice the signed area of a, b, c, seen along an axis.
Rational area(const Vector& a, const Vector& b, const Vector& c, int axis) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  return (b[p] - a[p]) * (c[q] - a[q]) - (b[q] - a[q]) * (c[p] - a[p]);
}

/// Angles about a -> b, counted from the half-plane of one tip, by half turn and cross product: positively scaled along each of its axes.
struct Angles {
  struct Direction {
    Rational x, y;
    bool isSecondHalf() const { return y.sign() < 0 || (y.sign() == 0 && x.sign() < 0); }
  };
  Vector origin, xAxis, yAxis;

  Angles(const Vector& a, const Vector& b, const Vector& tip) : origin(a) {
    yAxis = cross(b - a, tip - a);
    xAxis = cross(yAxis, b - a);
  }
  Direction of(const Vector& tip) const {
    const Vector t = tip - origin;
    return {dot(t, xAxis), dot(t, yAxis)};
  }
  static int compare(const Direction& s, const Direction& t) {
    if (s.isSecondHalf() != t.isSecondHalf()) return s.isSecondHalf() ? 1 : -1;
    return -(s.x * t.y - s.y * t.x).sign();
  }
};

// ---- P1 to P5: cut-vertices -------------------------------------------------------------------------------------------------------

struct Soup {
  Mesh mesh;
  Grid grid;

  void add(const Point& p) { mesh.positions.insert(mesh.positions.end(), p.begin(), p.end()); }
  void finish() {
    for (uint32_t v = 0; v < mesh.vertexCount(); ++v) mesh.triangles.push_back(v);
  }
};

/// Triangles with coordinates 0..9 and a grid at some of these, or at fractions between.
Soup latticeSoup(uint64_t seed) {
  Sampler sampler(Kind::lattice, seed);
  Soup soup;
  for (int i = 0; i < 3 * 8; ++i) soup.add(sampler.point());
  soup.finish();
  std::array<std::vector<double>, 3> planes;
  const double step = sampler.oneIn(3) ? 0.25 : 1;
  for (auto& p : planes) {
    for (double x = double(sampler.below(3)); x <= 9; x += step * double(1 + sampler.below(3))) p.push_back(x);
  }
  soup.grid = Grid::rectilinear(planes);
  return soup;
}

/// Random triangles in a uniform grid whose planes are rounded; many pass close to grid vertices and grid lines, by a side or inside.
Soup roundedSoup(uint64_t seed) {
  Sampler sampler(Kind::random, seed);
  Soup soup;
  soup.grid = Grid::box({-1.1, -1.1, -1.3}, {1.7, 1.3, 1.1}, {7, 6, 5});
  const auto gridVertex = [&] {
    Point p;
    for (int d = 0; d < 3; ++d) p[d] = soup.grid.planes[d][sampler.below(soup.grid.planes[d].size())];
    return p;
  };
  for (int i = 0; i < 12; ++i) {
    const Point g = gridVertex(), a = sampler.point();
    Point b = sampler.point();
    const int aim = int(sampler.below(4));  // at nothing, at a grid vertex by a side or by the inside, at a grid line by a side
    if (aim == 1) b = sampler.nudged(Sampler::combined(g, a, a, -0.5 - sampler.unit(), 0));
    if (aim == 3) b[0] = Sampler::combined(g, a, a, -1, 0)[0], b[1] = Sampler::combined(g, a, a, -1, 0)[1];
    soup.add(a);
    soup.add(b);
    soup.add(aim == 2 ? sampler.nudged(Sampler::combined(g, a, b, -0.5 - sampler.unit(), -0.5 - sampler.unit())) : sampler.point());
  }
  soup.finish();
  return soup;
}

/// Coordinates and planes of all magnitudes down to where input is flushed to 0.
Soup wideSoup(uint64_t seed) {
  Sampler sampler(Kind::wide, seed);
  Soup soup;
  std::array<std::vector<double>, 3> planes;
  for (auto& p : planes) {
    p = {-Sampler::kLimit / 2, 0, Sampler::kLimit / 2};
    for (int i = 0; i < 4; ++i) p.push_back(sampler.coordinate());
    std::sort(p.begin(), p.end());
    p.erase(std::unique(p.begin(), p.end()), p.end());
  }
  soup.grid = Grid::rectilinear(planes);
  for (int i = 0; i < 8; ++i) {
    const Point a = sampler.point(), b = sampler.point();
    soup.add(a);
    soup.add(b);
    soup.add(sampler.oneIn(2) ? sampler.point() : sampler.nudged(sampler.onLine(a, b)));
  }
  soup.finish();
  return soup;
}

/// A soup after stages 1 to 3, with some grid vertices, and where its vertices truly lie.
struct Cut : stages::StagedCut {
  Input& input = state.surface.input;
  const MeshEdges& edges = state.surface.edges();
  CutVertices& vertices = brick.vertices;
  TriFaces& faces = brick.triFaces;
  std::vector<VertexId> used;  // ids of vertices that there are
  IdVector<VertexId, Vector> points;

  explicit Cut(const Soup& soup) : StagedCut(soup.mesh, stages::Stage::triFaces, stages::unresolved(), soup.grid) {
    for (int32_t k = 0; k <= input.cells(2); k += 2) {
      for (int32_t j = 0; j <= input.cells(1); j += 2) {
        for (int32_t i = 0; i <= input.cells(0); i += 2) vertices.add({2 * i, 2 * j, 2 * k}, CutVertices::kNoTriangle);
      }
    }
    points.resize(vertices.size());
    for (const VertexId v : vertices.ids()) {
      if (!vertices.isUsed(v)) continue;
      used.push_back(v);
      points[v] = pointOf(v);
    }
  }

  Rational plane(int axis, int32_t index) const { return Rational(input.planes[axis][size_t(index)]); }
  Vector triVertex(VertexId v) const { return exact(input.point(v)); }
  bool inGrid(VertexId v) const { return input.inGrid(vertices.slab(v)); }

  Slab slabOf(const Vector& p) const {
    Slab slab;
    for (int d = 0; d < 3; ++d) {
      slab[d] = -1;
      for (int32_t k = 0; k <= input.cells(d); ++k) slab[d] = plane(d, k) < p[d] ? 2 * k + 1 : plane(d, k) == p[d] ? 2 * k : slab[d];
    }
    return slab;
  }

  /// Where plane `index` crosses a tri-edge: 0 at its lower end, 1 at its higher.
  Rational parameter(TriEdgeId edge, int axis, int32_t index) const {
    const Vector a = triVertex(edges.ends[edge][0]), b = triVertex(edges.ends[edge][1]);
    return (plane(axis, index) - a[axis]) / (b[axis] - a[axis]);
  }
  Vector onEdge(TriEdgeId edge, const Rational& t) const {
    const Vector a = triVertex(edges.ends[edge][0]);
    return a + t * (triVertex(edges.ends[edge][1]) - a);
  }

  std::array<Vector, 3> corners(TriangleId triangle) const {
    const auto t = input.verticesOf(triangle);
    return {triVertex(t[0]), triVertex(t[1]), triVertex(t[2])};
  }
  /// Where a grid line along g crosses the plane of a triangle; p has its other two coordinates. False if it is parallel.
  static bool meetLine(const std::array<Vector, 3>& t, int g, Vector& p) {
    const Vector normal = cross(t[1] - t[0], t[2] - t[0]);
    if (normal[g].sign() == 0) return false;
    const int e = (g + 1) % 3, f = (g + 2) % 3;
    p[g] = t[0][g] - (normal[e] * (p[e] - t[0][e]) + normal[f] * (p[f] - t[0][f])) / normal[g];
    return true;
  }
  static bool isInside(const std::array<Vector, 3>& t, int g, const Vector& p) {
    const int side = area(t[0], t[1], p, g).sign();
    return side != 0 && side == area(t[1], t[2], p, g).sign() && side == area(t[2], t[0], p, g).sign();
  }

 private:
  /// By the vertex's origin and one (on a tri-edge) or two (in a triangle) of the planes it claims to be on.
  Vector pointOf(VertexId v) const {
    if (vertices.isTriVertex(v)) return triVertex(v);
    const Slab& slab = vertices.slab(v);
    Vector p;
    if (vertices.isOnEdge(v)) {
      const auto& ends = edges.ends[vertices.triEdge(v)];
      for (int d = 0; d < 3; ++d) {
        if (onPlane(slab[d]) && input.point(ends[0])[d] != input.point(ends[1])[d])
          return onEdge(vertices.triEdge(v), parameter(vertices.triEdge(v), d, slab[d] / 2));
      }
      FAIL("a crossing without a plane");
    }
    for (int d = 0; d < 3; ++d) p[d] = onPlane(slab[d]) ? plane(d, slab[d] / 2) : Rational(0);
    if (!vertices.isInTriangle(v)) return p;
    for (int g = 0; g < 3; ++g) {
      if (onPlane(slab[(g + 1) % 3]) && onPlane(slab[(g + 2) % 3]) && meetLine(corners(vertices.triangle(v)), g, p)) return p;
    }
    FAIL("a vertex in a triangle without a grid line");
    return p;
  }
};

/// Runs `test` with cuts of all kinds of soup.
template <class Test>
void forCuts(int seeds, const Test& test) {
  for (int seed = 1; seed <= seeds; ++seed) {
    for (const auto make : {latticeSoup, roundedSoup, wideSoup}) {
      const Cut cut(make(uint64_t(seed)));
      test(cut);
    }
  }
}

/// Groups of vertices that may well tie: on one tri-edge, or in one triangle on one plane.
std::vector<std::vector<VertexId>> alignedVertices(const Cut& cut) {
  std::vector<std::vector<VertexId>> groups;
  for (const FaceId f : cut.faces.ids()) groups.push_back({cut.faces.loopsOf(f)[0].begin(), cut.faces.loopsOf(f)[0].end()});
  for (const TriEdgeId e : cut.edges.ends.ids()) {
    groups.push_back({cut.edges.ends[e].begin(), cut.edges.ends[e].end()});
    for (const VertexId v : cut.vertices.crossings(e)) {
      if (cut.vertices.isUsed(v)) groups.back().push_back(v);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const FaceEdge& first : cut.brick.faceEdges) {
      if (!onPlane(first.element[axis])) continue;
      groups.emplace_back();
      for (const FaceEdge& e : cut.brick.faceEdges) {
        if (e.element == first.element) groups.back().insert(groups.back().end(), {e.from, e.to});
      }
    }
  }
  return groups;
}

}  // namespace

TEST_CASE("P1: the crossings of a tri-edge, their order and their slabs", "[predicates]") {
  size_t crossings = 0, ties = 0;
  forCuts(12, [&](const Cut& cut) {
    for (const TriEdgeId e : cut.edges.ends.ids()) {
      const Point &a = cut.input.point(cut.edges.ends[e][0]), &b = cut.input.point(cut.edges.ends[e][1]);
      std::vector<Rational> expected;  // all crossings inside of the edge
      for (int d = 0; d < 3; ++d) {
        for (int32_t k = 0; k <= cut.input.cells(d) && a[d] != b[d]; ++k) {
          const Rational t = cut.parameter(e, d, k);
          if (t > Rational(0) && t < Rational(1)) expected.push_back(t);
        }
      }
      std::sort(expected.begin(), expected.end());
      const size_t all = expected.size();
      expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
      size_t i = 0;
      for (const VertexId v : cut.vertices.crossings(e)) {
        REQUIRE(cut.vertices.isUsed(v) == (i < expected.size()));
        if (i < expected.size()) REQUIRE(cut.vertices.slab(v) == cut.slabOf(cut.onEdge(e, expected[i])));
        ++i;
      }
      REQUIRE(i == all);
      crossings += expected.size();
      ties += all - expected.size();
    }
  });
  CHECK(crossings > 3000);
  CHECK(ties > 200);
}

TEST_CASE("P2: the grid lines that cross a triangle, and where", "[predicates]") {
  size_t crossings = 0, ties = 0;
  forCuts(12, [&](const Cut& cut) {
    std::vector<VertexId> inTriangles;
    for (const VertexId v : cut.used) {
      if (cut.vertices.isInTriangle(v)) inTriangles.push_back(v);
    }
    for (const VertexId v : inTriangles) REQUIRE(cut.vertices.slab(v) == cut.slabOf(cut.points[v]));
    for (const TriangleId t : cut.input.triangleIds()) {
      if (!cut.input.kept(t)) continue;
      const auto corners = cut.corners(t);
      std::vector<Slab> expected, found;
      for (int g = 0; g < 3; ++g) {
        const int e = (g + 1) % 3, f = (g + 2) % 3;
        for (int32_t i = 0; i <= cut.input.cells(e); ++i) {
          for (int32_t j = 0; j <= cut.input.cells(f); ++j) {
            Vector p;
            p[e] = cut.plane(e, i);
            p[f] = cut.plane(f, j);
            if (!Cut::meetLine(corners, g, p) || !Cut::isInside(corners, g, p)) continue;
            const Slab slab = cut.slabOf(p);
            if (cut.input.inGrid(slab)) expected.push_back(slab);
          }
        }
      }
      const size_t all = expected.size();
      std::sort(expected.begin(), expected.end());
      expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
      for (const VertexId v : inTriangles) {
        if (cut.vertices.triangle(v) != t) continue;
        int g = 0;
        while (area(corners[0], corners[1], corners[2], g).sign() == 0) ++g;
        REQUIRE(Cut::isInside(corners, g, cut.points[v]));
        if (cut.inGrid(v)) found.push_back(cut.vertices.slab(v));
      }
      std::sort(found.begin(), found.end());
      REQUIRE(found == expected);
      crossings += expected.size();
      ties += all - expected.size();
    }
  });
  CHECK(crossings > 1000);
  CHECK(ties > 100);
}

TEST_CASE("P3: the order of cut-vertices along an axis", "[predicates]") {
  size_t close = 0, ties = 0;
  Predicates predicates;
  forCuts(10, [&](const Cut& cut) {
    Sampler sampler(Kind::lattice);
    const auto compare = [&](VertexId u, VertexId v) {
      for (int axis = 0; axis < 3; ++axis) {
        const int expected = order(cut.points[u][axis], cut.points[v][axis]);
        REQUIRE(cut.vertices.compare(u, v, axis, predicates) == expected);
        if (cut.vertices.slab(u)[axis] != cut.vertices.slab(v)[axis] || onPlane(cut.vertices.slab(u)[axis])) continue;
        ++close;
        ties += u != v && expected == 0;
      }
    };
    for (int i = 0; i < 500; ++i) compare(cut.used[sampler.below(cut.used.size())], cut.used[sampler.below(cut.used.size())]);
    for (const auto& group : alignedVertices(cut)) {
      for (size_t i = 1; i < group.size(); ++i) compare(group[i - 1], group[i]);
    }
  });
  CHECK(close > 2000);
  CHECK(ties > 200);
  CHECK(predicates.fallbacks > 100);
}

TEST_CASE("P4, P5: the turn that cut-vertices take", "[predicates]") {
  int counts[3] = {};
  Predicates predicates;
  forCuts(10, [&](const Cut& cut) {
    Sampler sampler(Kind::lattice);
    const auto orient = [&](VertexId u, VertexId v, VertexId w) {
      for (int axis = 0; axis < 3; ++axis) {
        const int expected = area(cut.points[u], cut.points[v], cut.points[w], axis).sign();
        REQUIRE(cut.vertices.orient(u, v, w, axis, predicates) == expected);
        counts[expected + 1] += u != v && v != w && u != w;
      }
    };
    const auto any = [&](const std::vector<VertexId>& ids) { return ids[sampler.below(ids.size())]; };
    for (int i = 0; i < 200; ++i) orient(any(cut.used), any(cut.used), any(cut.used));
    for (const auto& group : alignedVertices(cut)) {
      if (sampler.oneIn(4)) orient(any(group), any(group), any(group));
    }
  });
  for (const int count : counts) CHECK(count > 1000);
  CHECK(predicates.fallbacks > 100);
}

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

TEST_CASE("Proven ranges of cut-vertices hold, and are narrow", "[predicates]") {
  Predicates predicates;
  forCuts(10, [&](const Cut& cut) {
    for (const VertexId v : cut.used) {
      if (!cut.inGrid(v)) continue;
      for (int d = 0; d < 3; ++d) {
        const CutVertices::Range range = cut.vertices.range(v, d, predicates);
        REQUIRE(Rational(range.low) <= cut.points[v][d]);
        REQUIRE(Rational(range.high) >= cut.points[v][d]);
        if (cut.vertices.isTriVertex(v) || onPlane(cut.vertices.slab(v)[d])) REQUIRE(range.low == range.high);
      }
    }
  });
  const Cut easy(roundedSoup(1));
  double widest = 0;
  for (const VertexId v : easy.used) {
    if (!easy.inGrid(v) || !easy.vertices.isOnEdge(v)) continue;
    const CutVertices::Range range = easy.vertices.range(v, 0, predicates);
    widest = std::max(widest, range.high - range.low);
  }
  CHECK(widest < 1e-12 * easy.input.planes[0].back());
}

namespace {

/// The number beside a plane, toward another: next to 0, what is not taken as 0 when it is read again.
double beside(double plane, double toward) {
  return plane == 0 ? std::copysign(std::min(0x1p-80, std::fabs(toward) / 2), toward) : std::nextafter(plane, toward);
}

}  // namespace

TEST_CASE("Positions of cut-vertices are rounded by little and never out of their slabs", "[predicates]") {
  // Output only. Relative to a corner of the parent triangle: 8 roundings allowed to the offset, 2 of the quotient, 1 of the sum.
  constexpr double kAllowed = 11 * kRoundoff;
  size_t clamped = 0;
  Predicates predicates;
  forCuts(10, [&](const Cut& cut) {
    for (const VertexId v : cut.used) {
      if (!cut.inGrid(v)) continue;
      const Point p = cut.vertices.position(v, predicates), r = cut.vertices.reference(v);
      for (int d = 0; d < 3; ++d) {
        const Rational& truth = cut.points[v][d];
        const int32_t slab = cut.vertices.slab(v)[d];
        if (cut.vertices.isTriVertex(v) || onPlane(slab)) {
          REQUIRE(Rational(p[d]) == truth);
          continue;
        }
        const double low = cut.input.planes[d][slab / 2], high = cut.input.planes[d][slab / 2 + 1];
        const double first = beside(low, high), last = beside(high, low);
        if (std::nextafter(low, high) < high) REQUIRE((low < p[d] && p[d] < high));
        const bool isClamped = (p[d] <= first && truth < Rational(p[d])) || (p[d] >= last && truth > Rational(p[d]));
        clamped += isClamped;
        if (!isClamped) REQUIRE(abs(Rational(p[d]) - truth) <= Rational(kAllowed) * Rational(std::max(std::fabs(p[d]), std::fabs(r[d]))));
      }
    }
  });
  CHECK(clamped > 50);
}

// ---- P6: triangles around a tri-edge ------------------------------------------------------------------------------------------------

namespace {

bool areOnLine(const Point& a, const Point& b, const Point& c) {
  const Vector n = cross(exact(b) - exact(a), exact(c) - exact(a));
  return n[0].sign() == 0 && n[1].sign() == 0 && n[2].sign() == 0;
}

}  // namespace

TEST_CASE("P6: the radial order of triangles around a tri-edge", "[predicates]") {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind);
    Predicates predicates;
    size_t equal = 0, opposite = 0;
    for (int repeat = 0; repeat < 400; ++repeat) {
      const Point a = sampler.point();
      Point b = sampler.point();
      const int flat = int(sampler.below(6));  // below 3: the edge and many triangles lie in a plane across this axis
      if (flat < 3) b[flat] = a[flat];
      std::vector<Point> tips;
      const bool ties = sampler.oneIn(2);
      const auto isTied = [&](const Point& s, const Point& t) {
        const Angles angles(exact(a), exact(b), exact(s));
        return Angles::compare(angles.of(exact(t)), angles.of(exact(s))) == 0;
      };
      const size_t wanted = 2 + sampler.below(6);
      for (int attempt = 0; attempt < 30 && tips.size() < wanted; ++attempt) {
        Point tip =
            tips.empty() || sampler.oneIn(2) ? sampler.point() : sampler.nudged(sampler.onPlane(a, b, tips[sampler.below(tips.size())]));
        if (flat < 3 && sampler.oneIn(2)) tip[flat] = a[flat];
        if (areOnLine(a, b, tip)) continue;
        bool tied = false;
        for (const Point& t : tips) tied |= isTied(t, tip);
        if (ties || !tied) tips.push_back(tip);
      }
      if (tips.size() < 2) continue;
      const bool open = sampler.oneIn(3);
      const Angles angles(exact(a), exact(b), exact(tips[0]));
      if (open) {  // those less than half a turn on, in any order
        tips.erase(std::remove_if(tips.begin(), tips.end(),
                                  [&](const Point& t) {
                                    const auto direction = angles.of(exact(t));
                                    return direction.isSecondHalf() || (direction.y.sign() == 0 && direction.x.sign() < 0);
                                  }),
                   tips.end());
        std::swap(tips[0], tips[sampler.below(tips.size())]);
      }
      std::vector<Flap> flaps;
      for (uint32_t i = 0; i < tips.size(); ++i) flaps.push_back({&tips[i], i});
      const size_t found = sortRadially(a, b, open, flaps, predicates);

      std::vector<uint8_t> seen(tips.size(), 0);
      size_t expected = 0;
      for (size_t i = 0; i < flaps.size(); ++i) {
        REQUIRE(flaps[i].tip == &tips[flaps[i].item]);
        REQUIRE(!seen[flaps[i].item]++);
        const auto direction = angles.of(exact(*flaps[i].tip));
        opposite += direction.y.sign() == 0 && direction.x.sign() < 0;
        if (i == 0) continue;
        const int order = Angles::compare(angles.of(exact(*flaps[i - 1].tip)), direction);
        REQUIRE(order <= 0);
        if (order == 0 && expected == 0) expected = i;
      }
      REQUIRE(found == expected);
      equal += found > 0;
    }
    CHECK(equal > 20);
    CHECK(opposite > 5);
    CHECK(predicates.fallbacks > 100);
  }
}

// ---- P7: nesting --------------------------------------------------------------------------------------------------------------------

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
    truth = meanOf({exact(corners[0]), exact(corners[1]), exact(corners[2])}, point.weights);
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

std::array<Vector, 3> exact(const std::array<Point, 3>& t) { return {exact(t[0]), exact(t[1]), exact(t[2])}; }

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
    if (!Cut::meetLine(corners, axis, meet)) return;
    std::array<Point, 3> u = randomTriangle(sampler);
    if (!sampler.oneIn(4)) {  // through the place where the first one is met
      const Point &a = t[0], &b = t[1], &c = t[2];
      const double x = b[(axis + 1) % 3] - a[(axis + 1) % 3], y = b[(axis + 2) % 3] - a[(axis + 2) % 3];
      u = sampler.oneIn(2) ? triangleThrough(sampler, shot.near, axis, true)
                           : std::array<Point, 3>{sampler.nudged(Sampler::combined(a, b, c, 0.25, 0.25)), b,
                                                  x * y == 0 ? c : sampler.nudged(sampler.onPlane(a, b, c))};
    }
    if (!Cut::meetLine(exact(u), axis, other)) return;
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
