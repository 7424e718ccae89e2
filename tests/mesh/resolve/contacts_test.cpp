// What two triangles have in common, against rational arithmetic: the number of corners, their places, and the places of made points.
#include "mesh/resolve/contacts.h"

#include <algorithm>
#include <map>

#include "catch.h"
#include "mesh/resolve/mesh_points.h"
#include "rational.h"
#include "samples.h"
#include "shapes.h"
#include "staged_cut.h"
#include "vectors.h"

using namespace mandoline;
using namespace mandoline::detail;
using namespace vectors;

namespace {

using Vector = std::array<Rational, 3>;
using Corners = std::array<Point, 3>;

bool coincide(const MeshPoints& points, uint32_t u, uint32_t v) {
  Predicates predicates;
  for (int axis = 0; axis < 3; ++axis) {
    if (points.compare(u, v, axis, predicates) != 0) return false;
  }
  return true;
}

Vector exact(const Point& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

/// What a convex polygon has on the side of the plane through p that its normal points to.
std::vector<Vector> clip(const std::vector<Vector>& polygon, const Vector& normal, const Vector& p) {
  std::vector<Vector> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Rational ha = dot(normal, a - p), hb = dot(normal, b - p);
    if (ha.sign() >= 0) kept.push_back(a);
    if (ha.sign() * hb.sign() < 0) kept.push_back(a + (ha / (ha - hb)) * (b - a));
  }
  return kept;
}

/// All corners of what two triangles have in common, each once.
std::vector<Vector> commonCorners(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b) {
  const Vector normal = cross(b[1] - b[0], b[2] - b[0]), zero;
  std::vector<Vector> common = clip(clip({a.begin(), a.end()}, normal, b[0]), zero - normal, b[0]);
  for (size_t i = 0; i < 3; ++i) common = clip(common, cross(normal, b[(i + 1) % 3] - b[i]), b[i]);
  std::vector<Vector> corners;
  for (const Vector& p : common) {
    if (std::find(corners.begin(), corners.end(), p) == corners.end()) corners.push_back(p);
  }
  std::erase_if(corners, [&](const Vector& p) {  // between two others
    for (const Vector& q : corners) {
      for (const Vector& r : corners) {
        if (cross(q - p, r - p) == zero && dot(q - p, r - p).sign() < 0) return true;
      }
    }
    return false;
  });
  return corners;
}

/// A point by its key: where an edge meets a plane, or an edge an edge.
Vector placeOf(const WeldedMesh& mesh, const PointKey& key) {
  const auto at = [&](uint32_t v) { return exact(mesh.points[v]); };
  const Vector a = at(key.ids[0]);
  if (key.kind == PointKey::Kind::vertex) return a;
  const Vector along = at(key.ids[1]) - a;
  if (key.kind == PointKey::Kind::edgeTriangle) {
    const auto& t = mesh.triangles[key.ids[2]];
    const Vector normal = cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    return a + (dot(normal, at(t[0]) - a) / dot(normal, along)) * along;
  }
  REQUIRE(key.kind == PointKey::Kind::edgeEdge);
  const Vector c = at(key.ids[2]), other = at(key.ids[3]) - c, normal = cross(along, other);
  return a + (dot(cross(c - a, other), normal) / dot(normal, normal)) * along;
}

/// The place of a point of a triangle's plane.
Place placeIn(const std::array<Vector, 3>& t, const Vector& p) {
  const Vector normal = cross(t[1] - t[0], t[2] - t[0]);
  std::array<bool, 3> on;
  for (size_t i = 0; i < 3; ++i) on[i] = dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal).sign() == 0;
  for (int i = 0; i < 3; ++i) {
    if (p == t[size_t(i)]) return Place::corner(i);
  }
  for (int i = 0; i < 3; ++i) {
    if (on[size_t(i)]) return Place::side(i);
  }
  return Place();
}

/// A triangle that meets another more often than by chance.
Corners triangleNear(Sampler& sampler, const Corners& t) {
  Corners corners;
  for (Point& p : corners) {
    const uint64_t way = sampler.below(5);
    p = way == 0   ? sampler.point()
        : way == 1 ? t[sampler.below(3)]
        : way == 2 ? sampler.onLine(t[0], t[1 + sampler.below(2)])
                   : sampler.onPlane(t[0], t[1], t[2]);
  }
  return corners;
}

}  // namespace

TEST_CASE("contacts: corners, places and kinds are those that rational arithmetic gives", "[contacts]") {
  std::map<IntersectionKind, size_t> kinds;
  size_t none = 0;
  for (const Kind kind : {Kind::lattice, Kind::random, Kind::largeLattice, Kind::wide}) {
    Sampler sampler(kind);
    Predicates predicates;
    for (int run = 0; run < 900; ++run) {
      const Corners first = {sampler.point(), sampler.point(), sampler.point()};
      const stages::StagedCut cut(shapes::soup({first, triangleNear(sampler, first)}), stages::Stage::input, stages::unresolved());
      const Prepared& mesh = *cut.prepared;
      if (!mesh.kept(size_t(0)) || !mesh.kept(size_t(1))) continue;
      std::array<Vector, 3> a, b;
      for (size_t i = 0; i < 3; ++i) a[i] = exact(mesh.points[mesh.triangles[0][i]]), b[i] = exact(mesh.points[mesh.triangles[1][i]]);
      const std::vector<Vector> expected = commonCorners(a, b);
      const auto isShared = [&](const Vector& p) { return placeIn(a, p).isCorner() && placeIn(b, p).isCorner(); };
      const bool meets = !std::all_of(expected.begin(), expected.end(), isShared);
      PairContact pair;
      REQUIRE(PairTest(mesh).find(0, 1, pair) == meets);
      if (!meets) {
        ++none;
        continue;
      }
      ++kinds[pair.kind()];
      REQUIRE(size_t(pair.contact.count) == expected.size());
      MeshPoints points(mesh);
      for (int i = 0; i < pair.contact.count; ++i) {
        const auto& [key, places] = pair.contact.corners[size_t(i)];
        const Vector place = placeOf(mesh, key);
        REQUIRE(std::find(expected.begin(), expected.end(), place) != expected.end());
        REQUIRE(places[0].code == placeIn(a, place).code);
        REQUIRE(places[1].code == placeIn(b, place).code);
        if (key.kind == PointKey::Kind::vertex) continue;
        const uint32_t id = points.add(key);
        points.place(id, predicates);
        for (int d = 0; d < 3; ++d) {
          const Bounded near = points.approximate(id, d);
          REQUIRE(abs(Rational(near.value) - place[size_t(d)]) <= Rational(near.error));
          REQUIRE(points.compareWith(id, d, near.value, predicates) == order(place[size_t(d)], Rational(near.value)));
        }
      }
    }
  }
  CHECK(none > 50);
  using K = IntersectionKind;
  for (const K kind : {K::crossing, K::touching, K::overlapping, K::folded}) {
    CAPTURE(kind);
    CHECK(kinds[kind] > 20);
  }
}

TEST_CASE("contacts: made points in one place are one vertex", "[contacts]") {
  // Three planes through one line that a fourth triangle crosses, and an edge in that line: one point by many keys.
  std::vector<Corners> triangles = {{{{-1, -1, 0.5}, {3, -1, 0.5}, {1, 3, 0.5}}}};
  for (const Point& away : {Point{1, 0, 0}, Point{0, 1, 0}, Point{1, 1, 0}, Point{-1, 2, 0}}) {
    triangles.push_back({{{1 - away[0], 1 - away[1], -1}, {1 + away[0], 1 + away[1], 0}, {1 - away[0], 1 - away[1], 2}}});
  }
  const stages::StagedCut cut(shapes::soup(triangles), stages::Stage::input, CutOptions());
  const Arrangement& arrangement = *cut.prepared->arrangement;
  size_t there = 0;
  for (const MadeEdge& edge : arrangement.madeEdges) {
    for (const uint32_t v : edge.ends()) {
      const Point p = arrangement.points.reference(v);
      there += arrangement.points.isMade(v) && p[0] == p[1] && p[2] == p[0] / 2;
    }
  }
  CHECK(there >= 8);  // eight half-lines end there
  std::vector<uint32_t> ids;
  for (const MadeEdge& edge : arrangement.madeEdges) ids.insert(ids.end(), {edge.low, edge.high});
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (size_t i = 0; i < ids.size(); ++i) {
    for (size_t j = 0; j < i; ++j) CHECK_FALSE(coincide(arrangement.points, ids[i], ids[j]));
  }
}
