// Which triangles meet other than in shared vertices and edges, exactly, and which pair a cut names that met a contradiction.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "catch.h"
#include "cut/contradiction.h"
#include "cut/stages/input.h"
#include "lattice.h"
#include "mesh/resolve/contacts.h"
#include "staged_cut.h"
#include "vectors.h"

using namespace mandoline;
using namespace mandoline::detail;
using namespace vectors;

namespace {

using Corners = std::array<Point, 3>;

const Grid kGrid = Grid::regular({-64, -64, -64}, {32, 32, 32}, {4, 4, 4});

using stages::unresolved;

/// Triangles whose intersections nobody looked for yet.
struct Unresolved : stages::StagedCut {
  const Input& input = state.surface.input;

  explicit Unresolved(const std::vector<Corners>& triangles, const Grid& grid = kGrid)
      : StagedCut(shapes::soup(triangles), stages::Stage::input, unresolved(), grid) {}
  bool meet(uint32_t s, uint32_t t) const { return PairTest(*prepared).meet(s, t); }
};

/// Whether the first two triangles meet. The answer has to be the same in any order of triangles, corners and axes, and anywhere.
bool meet(const std::vector<Corners>& triangles) {
  int met = 0, asked = 0;
  std::array<int, 3> axes = {0, 1, 2};
  do {
    for (const double shift : {0.0, -3.0, 16.0}) {
      std::array<int, 6> order = {0, 1, 2, 0, 1, 2};
      do {
        do {
          std::vector<Corners> placed = triangles;
          for (size_t t = 0; t < placed.size(); ++t) {
            for (int i = 0; i < 3; ++i) {
              for (int d = 0; d < 3; ++d) placed[t][i][d] = triangles[t][t < 2 ? order[3 * t + i] : i][axes[d]] + shift;
            }
          }
          const Unresolved mesh(placed);
          met += mesh.meet(0, 1) + mesh.meet(1, 0);
          asked += 2;
        } while (std::next_permutation(order.begin(), order.begin() + 3));
      } while (std::next_permutation(order.begin() + 3, order.end()));
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  CHECK(asked == 2 * 6 * 3 * 36);
  CHECK((met == 0 || met == asked));
  return met > 0;
}

bool meet(const Corners& a, const Corners& b) { return meet(std::vector<Corners>{a, b}); }

// ------------------------------------------------------------- the same by clipping one triangle with the other, in whole numbers

using Whole = std::array<int64_t, 3>;
using WholeTriangle = std::array<Whole, 3>;

struct Fraction {
  Whole x;
  int64_t w;  ///< the point is x / w
};

Whole normalOf(const WholeTriangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }
bool hasArea(const WholeTriangle& t) { return normalOf(t) != Whole{0, 0, 0}; }

/// The part of a convex polygon on the side of the plane through p that its normal points to.
std::vector<Fraction> clip(const std::vector<Fraction>& polygon, const Whole& normal, const Whole& p) {
  std::vector<Fraction> kept;
  const auto height = [&](const Fraction& f) { return dot(normal, f.x) - dot(normal, p) * f.w; };
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Fraction &f = polygon[i], &g = polygon[(i + 1) % polygon.size()];
    const int64_t hf = height(f), hg = height(g);
    if (hf >= 0) kept.push_back(f);
    if ((hf > 0 && hg < 0) || (hf < 0 && hg > 0)) {
      const int64_t s = std::abs(hf), t = std::abs(hg);
      Fraction between{{}, t * f.w + s * g.w};
      int64_t divisor = between.w;
      for (int d = 0; d < 3; ++d) divisor = std::gcd(divisor, between.x[d] = t * f.x[d] + s * g.x[d]);
      for (int64_t& x : between.x) x /= divisor;
      between.w /= divisor;
      kept.push_back(between);
    }
  }
  return kept;
}

bool wholeMeet(const WholeTriangle& a, const WholeTriangle& b) {
  std::vector<Fraction> common;
  for (const Whole& p : a) common.push_back({p, 1});
  const Whole normal = normalOf(b);
  common = clip(clip(common, normal, b[0]), Whole{0, 0, 0} - normal, b[0]);
  for (int i = 0; i < 3; ++i) common = clip(common, cross(normal, b[(i + 1) % 3] - b[i]), b[i]);
  std::vector<Whole> shared;
  for (const Whole& p : a) {
    if (std::find(b.begin(), b.end(), p) != b.end()) shared.push_back(p);
  }
  if (shared.size() == 3) return true;
  const auto isShared = [&](const Fraction& f) {  // it lies in both triangles, so on the line of their shared edge is on that edge
    if (shared.empty()) return false;
    const Whole fromFirst = {f.x[0] - shared[0][0] * f.w, f.x[1] - shared[0][1] * f.w, f.x[2] - shared[0][2] * f.w};
    return cross(fromFirst, shared.back() - shared[0]) == Whole{0, 0, 0} && (shared.size() == 2 || fromFirst == Whole{0, 0, 0});
  };
  return !std::all_of(common.begin(), common.end(), isShared);
}

/// Compares all pairs of the triangles with wholeMeet, as they are and sheared, so that planes are tilted.
void comparePairs(const std::vector<WholeTriangle>& triangles) {
  std::vector<Corners> straight, sheared;
  for (const WholeTriangle& t : triangles) {
    Corners c, s;
    for (int i = 0; i < 3; ++i) {
      const double x = double(t[i][0]), y = double(t[i][1]), z = double(t[i][2]);
      c[i] = {x, y, z};
      s[i] = {x + 3 * y + 5 * z, 2 * x + 7 * y - z, x - 2 * y + 4 * z};
    }
    straight.push_back(c);
    sheared.push_back(s);
  }
  const Unresolved straightMesh(straight), shearedMesh(sheared);
  PairTest pairTest(*straightMesh.prepared), shearedTest(*shearedMesh.prepared);
  size_t met = 0, wrong = 0;
  for (uint32_t s = 0; s < triangles.size(); ++s) {
    for (uint32_t t = s + 1; t < triangles.size(); ++t) {
      const bool expected = wholeMeet(triangles[s], triangles[t]);
      met += expected;
      wrong += pairTest.meet(s, t) != expected || pairTest.meet(t, s) != expected || shearedTest.meet(s, t) != expected;
    }
  }
  const size_t pairs = triangles.size() * (triangles.size() - 1) / 2;
  CHECK(met > pairs / 10);
  CHECK(met < pairs);
  CHECK(wrong == 0);
}

std::vector<WholeTriangle> trianglesOf(const std::vector<Whole>& points) {
  std::vector<WholeTriangle> triangles;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = i + 1; j < points.size(); ++j) {
      for (size_t k = j + 1; k < points.size(); ++k) {
        const WholeTriangle t = {points[i], points[j], points[k]};
        if (hasArea(t)) triangles.push_back(t);
      }
    }
  }
  return triangles;
}

std::vector<Whole> latticePoints(int64_t nx, int64_t ny, int64_t nz) {
  std::vector<Whole> points;
  for (int64_t i = 0; i < nx * ny * nz; ++i) points.push_back({i % nx, i / nx % ny, i / nx / ny});
  return points;
}

const Corners kBase = {Point{0, 0, 0}, Point{4, 0, 0}, Point{0, 4, 0}};

Error explained(const Unresolved& mesh, int64_t blamed, int64_t alsoBlamed, CutStats stats = {}) {
  const RunOptions options;
  Monitor monitor(options, 1);
  Run run{stats, monitor};
  return explainContradiction(mesh.input, blamed, alsoBlamed, run);
}

/// The pair that is named for a guess, as (element, element2).
std::array<int64_t, 2> namedPair(const Unresolved& mesh, int64_t blamed, int64_t alsoBlamed) {
  const Error error = explained(mesh, blamed, alsoBlamed);
  CHECK(error.status == Status::selfIntersection);
  CHECK(error.message == "Triangles " + std::to_string(error.element) + " and " + std::to_string(error.element2) +
                             " meet other than in a shared vertex or edge.");
  return {error.element, error.element2};
}

}  // namespace

TEST_CASE("triangles apart do not meet", "[intersections]") {
  CHECK_FALSE(meet(kBase, {{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}}));       // parallel planes
  CHECK_FALSE(meet(kBase, {{{3, 3, 0}, {5, 3, 0}, {3, 5, 0}}}));       // in one plane, boxes overlap
  CHECK_FALSE(meet(kBase, {{{5, 0, 0}, {6, 0, 0}, {8, 0, 1}}}));       // an edge on the other's edge line
  CHECK_FALSE(meet(kBase, {{{3, 3, -1}, {3, 3, 1}, {1, 4, 1}}}));      // crosses the other's plane beside it
  CHECK_FALSE(meet(kBase, {{{4, 4, -4}, {4, 4, 4}, {1, 4, 4}}}));      // each crosses the other's plane
  CHECK_FALSE(meet(kBase, {{{2, 3, 0}, {4, 4, 1}, {4, 4, -1}}}));      // a vertex in the plane, beside
  CHECK_FALSE(meet(kBase, {{{1, 1, 0.0625}, {2, 1, 1}, {1, 2, 1}}}));  // close above
}

TEST_CASE("a shared vertex is no intersection", "[intersections]") {
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {1, 0, 4}, {0, 1, 4}}}));
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {-1, 1, 1}, {1, -1, 1}}}));   // touching the plane's line only there
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {1, -1, 1}, {1, -1, -1}}}));  // through the plane beside
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {-4, 0, 0}, {0, -4, 0}}}));   // in one plane, edges continue each other
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {-1, 2, 0}, {-2, 1, 0}}}));
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {-4, 0, 0}, {1, 1, 1}}}));  // an edge on the same line, away
}

TEST_CASE("a shared edge is no intersection", "[intersections]") {
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {4, 0, 0}, {1, 1, 1}}}));
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {4, 0, 0}, {1, -1, 0}}}));  // flat
  CHECK_FALSE(meet(kBase, {{{4, 0, 0}, {0, 4, 0}, {4, 4, 0}}}));
  CHECK_FALSE(meet(kBase, {{{0, 0, 0}, {4, 0, 0}, {1, 8, 0.0625}}}));  // nearly folded
}

TEST_CASE("crossing triangles meet", "[intersections]") {
  CHECK(meet(kBase, {{{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}}));             // an edge of one through the other
  CHECK(meet(kBase, {{{1, 1, -1}, {2, 1, 1}, {1, 2, 1}}}));             // two edges of one
  CHECK(meet(kBase, {{{0, 0, 0}, {1, 1, -1}, {1, 1, 1}}}));             // from a shared vertex on
  CHECK(meet(kBase, {{{0, 0, 0}, {4, 4, -1}, {4, 4, 1}}}));             // from a shared vertex through the opposite side
  CHECK(meet(kBase, {{{0, 0, 0}, {-4, -4, -1}, {4, 4, 3}}}) == false);  // the line goes on, the triangle does not
}

TEST_CASE("touching triangles meet", "[intersections]") {
  CHECK(meet(kBase, {{{1, 1, 0}, {1, 1, 3}, {2, 1, 3}}}));    // vertex on face
  CHECK(meet(kBase, {{{2, 2, 0}, {1, 1, 3}, {2, 1, 3}}}));    // vertex on edge
  CHECK(meet(kBase, {{{2, 2, 0}, {4, 4, 0}, {3, 4, 0}}}));    // vertex on edge, in one plane
  CHECK(meet(kBase, {{{2, 0, -1}, {2, 0, 1}, {2, -1, 0}}}));  // edge across edge
  CHECK(meet(kBase, {{{1, 1, 0}, {2, 1, 0}, {1, 1, 2}}}));    // edge in face
  CHECK(meet(kBase, {{{-1, 1, 0}, {9, 1, 0}, {1, 1, 2}}}));   // edge all across the face
  CHECK(meet(kBase, {{{0, 0, 0}, {1, 1, 0}, {1, 1, 2}}}));    // edge in face, from a shared vertex
  CHECK(meet(kBase, {{{0, 0, 0}, {2, 2, 0}, {1, 1, 2}}}));    // up to the opposite side
  CHECK(meet(kBase, {{{0, 0, 0}, {5, 5, 0}, {1, 1, 2}}}));    // and beyond
}

TEST_CASE("edges that overlap without being the same meet", "[intersections]") {
  for (const double z : {0.0, 2.0}) {                           // in one plane, or not
    CHECK(meet(kBase, {{{1, 0, 0}, {2, 0, 0}, {1, -1, z}}}));   // within
    CHECK(meet(kBase, {{{-1, 0, 0}, {2, 0, 0}, {1, -1, z}}}));  // partly
    CHECK(meet(kBase, {{{-1, 0, 0}, {5, 0, 0}, {1, -1, z}}}));  // over it
    CHECK(meet(kBase, {{{0, 0, 0}, {2, 0, 0}, {1, -1, z}}}));   // from a shared vertex: a T-junction
    CHECK(meet(kBase, {{{0, 0, 0}, {5, 0, 0}, {1, -1, z}}}));
    CHECK(meet(kBase, {{{4, 0, 0}, {5, 0, 0}, {5, -1, z}}}) == false);  // only the end
  }
}

TEST_CASE("triangles that overlap in one plane meet", "[intersections]") {
  CHECK(meet(kBase, {{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}));  // one within the other
  CHECK(meet(kBase, {{{-8, -8, 0}, {16, -8, 0}, {-8, 16, 0}}}));
  CHECK(meet(kBase, {{{-1, 1, 0}, {3, 2, 0}, {3, -1, 0}}}));  // a star: sides cross
  CHECK(meet(kBase, {{{3, 3, 0}, {1, 1, 0}, {4, 3, 0}}}));    // one vertex within
  CHECK(meet(kBase, {{{0, 0, 0}, {1, 2, 0}, {2, 1, 0}}}));    // from a shared vertex
  CHECK(meet(kBase, {{{0, 0, 0}, {4, 8, 0}, {8, 4, 0}}}));
  CHECK(meet(kBase, {{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}}}));  // folded along a shared edge
  CHECK(meet(kBase, {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}}));
  CHECK(meet(kBase, {{{0, 0, 0}, {4, 0, 0}, {0, 8, 0}}}));  // and along a part of another
  CHECK(meet(kBase, kBase));
}

TEST_CASE("one unit in the last place decides", "[intersections]") {
  const Corners tilted = {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  const double up = std::nextafter(0.5, 1), down = std::nextafter(0.5, 0);
  const auto touching = [&](double z) { return Corners{Point{0.25, 0.25, z}, Point{1, 1, 1}, Point{1, 1, 2}}; };
  CHECK(Unresolved({tilted, touching(0.5)}).prepared->kept(size_t(1)));
  const auto meetAt = [&](double z) { return Unresolved({tilted, touching(z)}).meet(0, 1); };
  CHECK(meetAt(0.5));
  CHECK(meetAt(down));
  CHECK_FALSE(meetAt(up));
}

TEST_CASE("neighbours along a stitched side share its edges", "[intersections]") {
  // The side from a to b holds m and n, of triangles without area.
  const Point a = {0, 0, 0}, m = {1, 0, 0}, n = {2, 0, 0}, b = {4, 0, 0}, apex = {0, 4, 0};
  const Corners side = {a, b, apex};
  const std::vector<Corners> flat = {{{a, m, n}}, {{a, n, b}}};
  const auto meetStitched = [&](const Corners& first, const Corners& second) {
    std::vector<Corners> triangles = {first, second};
    triangles.insert(triangles.end(), flat.begin(), flat.end());
    return meet(triangles);
  };
  for (const double z : {0.0, 2.0}) {  // in one plane, or not
    const Point below = {1, -2, z};
    for (const auto& [p, q] : {std::array<Point, 2>{a, m}, {m, n}, {n, b}, {a, n}, {a, b}}) {
      CHECK_FALSE(meetStitched(side, {{p, q, below}}));
      CHECK(meet(side, {{p, q, below}}) == (p != a || q != b));  // without stitching, the side is one edge
    }
    CHECK(meetStitched(side, {{m, b, below}}));               // no side of the triangles without area
    CHECK(meetStitched(side, {{Point{3, 0, 0}, b, below}}));  // no vertex of theirs
    CHECK(meetStitched(side, {{Point{-1, 0, 0}, m, below}}));
    CHECK_FALSE(meetStitched(side, {{m, Point{0.5, -1, z}, below}}));  // a vertex of the side alone
    CHECK_FALSE(meetStitched({{a, n, apex}}, {{a, b, below}}));        // both sides stitched, one longer
    CHECK_FALSE(meetStitched({{a, n, apex}}, {{n, b, below}}));
    CHECK(meetStitched({{a, n, apex}}, {{m, b, below}}));
  }
  CHECK(meetStitched(side, {{m, n, Point{1, 1, 0}}}));  // folded
  CHECK(meetStitched(side, {{a, b, Point{1, 1, 0}}}));
  CHECK(meetStitched(side, {{m, Point{1, 1, 0}, Point{2, 1, 0}}}));  // from a vertex of the side inward
  CHECK(meetStitched(side, {{m, Point{1, 1, -1}, Point{1, 1, 1}}}));
  CHECK(meetStitched(side, {{m, Point{0, 2, 0}, Point{0, 0, 3}}}));
  CHECK_FALSE(meetStitched(side, {{m, Point{1, -1, -1}, Point{1, -1, 1}}}));
}

TEST_CASE("stitched sides on one line that go different ways meet", "[intersections]") {
  // Both sides begin with the edge from p to q, then one ends in r and the other passes by it.
  const Point p = {0, 0, 0}, q = {1, 0, 0}, r = {2, 0, 0}, s = {4, 0, 0}, t = {6, 0, 0};
  const std::vector<Corners> flat = {{{p, q, r}}, {{p, s, t}}, {{t, s, q}}};
  for (const double z : {0.0, 2.0}) {
    std::vector<Corners> triangles = {{{p, r, Point{0, 4, 0}}}, {{p, s, Point{1, -2, z}}}};
    triangles.insert(triangles.end(), flat.begin(), flat.end());
    CHECK(meet(triangles));
    triangles[1][1] = q;
    CHECK_FALSE(meet(triangles));
  }
}

TEST_CASE("all pairs of triangles on a lattice", "[intersections]") { comparePairs(trianglesOf(latticePoints(3, 3, 2))); }

TEST_CASE("all pairs of triangles in one plane of a lattice", "[intersections]") { comparePairs(trianglesOf(latticePoints(4, 4, 1))); }

TEST_CASE("random triangles on a larger lattice", "[intersections]") {
  std::mt19937 random(1);
  std::vector<WholeTriangle> triangles;
  while (triangles.size() < 500) {
    WholeTriangle t;
    for (Whole& p : t) p = {int64_t(random() % 6), int64_t(random() % 6), int64_t(random() % 6)};
    if (hasArea(t)) triangles.push_back(t);
  }
  comparePairs(triangles);
}

TEST_CASE("the pair that is named meets", "[intersections]") {
  const auto at = [](double x, double z) { return Corners{Point{x, 0, z}, Point{x + 4, 0, z}, Point{x, 4, z}}; };
  const auto post = [](double x, double z) { return Corners{Point{x + 1, 1, z - 1}, Point{x + 1, 1, z + 1}, Point{x + 1, 2, z + 1}}; };
  // 1 and 6, 2 and 5, 3 and 5 meet; 0 and 4 meet nothing.
  const Unresolved mesh({at(-20, 0), at(10, 0), at(0, 0.25), at(0, 0), at(-10, 0), post(0, 0), post(10, 0)});
  CHECK(namedPair(mesh, 2, 5) == std::array<int64_t, 2>{2, 5});  // as blamed
  CHECK(namedPair(mesh, 5, 3) == std::array<int64_t, 2>{3, 5});
  CHECK(namedPair(mesh, 5, 5) == std::array<int64_t, 2>{2, 5});  // blamed, with the lowest that it meets
  CHECK(namedPair(mesh, 6, 5) == std::array<int64_t, 2>{1, 6});
  CHECK(namedPair(mesh, 0, 3) == std::array<int64_t, 2>{3, 5});
  CHECK(namedPair(mesh, -1, 3) == std::array<int64_t, 2>{3, 5});
  CHECK(namedPair(mesh, 0, 4) == std::array<int64_t, 2>{1, 6});  // the lowest of all
  CHECK(namedPair(mesh, -1, -1) == std::array<int64_t, 2>{1, 6});
}

TEST_CASE("the lowest pair of many triangles is found", "[intersections]") {
  std::mt19937 random(3);
  const auto number = [&](double size) { return size * double(random() >> 12) * 0x1p-20; };
  for (int run = 0; run < 40; ++run) {
    std::vector<Corners> triangles(400);
    for (Corners& corners : triangles) {
      const Point centre = {number(8), number(8), number(8)};
      for (Point& corner : corners) {
        for (int d = 0; d < 3; ++d) corner[d] = centre[d] + number(1);
      }
    }
    const Unresolved mesh(triangles);
    PairTest pairs(*mesh.prepared);
    std::array<int64_t, 2> lowest = {-1, -1};
    for (uint32_t s = 0; s < triangles.size() && lowest[0] < 0; ++s) {
      for (uint32_t t = s + 1; t < triangles.size() && lowest[0] < 0; ++t) {
        if (pairs.meet(s, t)) lowest = {s, t};
      }
    }
    REQUIRE(lowest[0] >= 0);
    CHECK(namedPair(mesh, -1, -1) == lowest);
  }
}

TEST_CASE("boxes that only touch are searched", "[intersections]") {
  CHECK(namedPair(Unresolved({kBase, {{{2, 2, 0}, {3, 4, 1}, {4, 3, 1}}}}), -1, -1) == std::array<int64_t, 2>{0, 1});   // above each other
  CHECK(namedPair(Unresolved({kBase, {{{4, -1, 0}, {4, 1, 0}, {5, 0, 0}}}}), -1, -1) == std::array<int64_t, 2>{0, 1});  // beside
}

TEST_CASE("a pair beside the grid is not named", "[intersections]") {
  for (const double aside : {9.0, -9.0}) {
    const Corners base = {Point{aside, 0, 0}, Point{aside + 3, 0, 0}, Point{aside, 4, 0}};
    const Corners post = {Point{aside + 1, 1, -1}, Point{aside + 1, 1, 1}, Point{aside + 1, 2, 1}};
    const std::vector<Corners> triangles = {base, post, kBase, {{{1, 1, -1}, {1, 1, 1}, {1, 2, 1}}}};
    CHECK(namedPair(Unresolved(triangles, Grid::regular({0, 0, 0}, {1, 1, 1}, {8, 8, 8})), -1, -1) == std::array<int64_t, 2>{2, 3});
    CHECK(namedPair(Unresolved(triangles), -1, -1) == std::array<int64_t, 2>{0, 1});
  }
}

TEST_CASE("triangles that meet only after snapping are reported as such", "[intersections]") {
  CutStats stats;
  stats.snappedVertices = 1;
  const Unresolved mesh({kBase, {{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}});
  CHECK(explained(mesh, 0, 1, stats).message == "Triangles 0 and 1 meet other than in a shared vertex or edge after snapping.");
}

TEST_CASE("no triangles are blamed for the cutter's own faults", "[intersections]") {
  const Error error = explained(Unresolved({kBase, {{{0, 0, 0}, {4, 0, 0}, {1, 1, 1}}}}), 0, 1);
  CHECK(error.status == Status::internalError);
  CHECK(error.element == -1);
  CHECK(error.element2 == -1);
}

TEST_CASE("no triangles are blamed once all intersections are resolved", "[intersections]") {
  const stages::StagedCut resolved(shapes::soup({kBase, {{{1, 1, -1}, {1, 1, 1}, {1, 2, 1}}}}), stages::Stage::input, {}, kGrid);
  CutStats stats;
  const RunOptions options;
  Monitor monitor(options, 1);
  Run run{stats, monitor};
  const Error error = explainContradiction(resolved.state.surface.input, 0, 1, run);
  CHECK(error.status == Status::internalError);
  CHECK(error.element == -1);
  CHECK(error.message.find("resolved") != std::string::npos);
}

TEST_CASE("the search for a pair that meets shows progress and can be cancelled", "[intersections]") {
  std::vector<Corners> apart;
  for (int i = 0; i < 5000; ++i) apart.push_back({{{4.0 * i, 0, 0}, {4.0 * i + 1, 0, 0}, {4.0 * i, 1, 0}}});
  const Unresolved mesh(apart, Grid::regular({-1, -1, -1}, {20002, 3, 3}, {1, 1, 1}));
  CutStats stats;
  int calls = 0, left = 1000;
  double last = -1;
  RunOptions options;
  options.progress = [&](const Progress& progress) {
    const double done = double(progress.done) / double(progress.total);
    CHECK(done > last);
    last = done;
    ++calls;
    return left-- > 0;
  };
  Monitor monitor(options, 1);
  Run run{stats, monitor};
  CHECK(explainContradiction(mesh.input, -1, -1, run).status == Status::internalError);
  CHECK(calls > 3);
  left = 2;
  last = -1;
  CHECK_THROWS_AS(explainContradiction(mesh.input, -1, -1, run), Cancelled);
}

TEST_CASE("an unresolved cut that met a contradiction can be cancelled", "[intersections]") {
  std::mt19937 random(7);
  size_t refused = 0;
  for (int run = 0; run < 1000 && refused < 3; ++run) {
    std::vector<uint8_t> bytes(20 + random() % 200);
    for (uint8_t& byte : bytes) byte = uint8_t(random() >> 24);
    const LatticeCase latticeCase = decodeLattice(bytes.data(), bytes.size());
    CutOptions options = unresolved();
    if (cut(latticeCase.mesh, latticeCase.grid, options).error.status != Status::selfIntersection) continue;
    ++refused;
    int stage = -1;
    options.progress = [&](const Progress& progress) {
      CHECK(progress.stageIndex >= stage);
      CHECK(progress.stageIndex < progress.stageCount);
      stage = progress.stageIndex;
      return progress.stage != std::string("intersections");
    };
    CHECK(cut(latticeCase.mesh, latticeCase.grid, options).error.status == Status::cancelled);
  }
  CHECK(refused == 3);
}

TEST_CASE("unresolved meshes on a lattice that are refused name a pair that meets", "[intersections][latticesoups]") {
  std::mt19937 random(7);
  size_t refused = 0;
  for (int run = 0; run < 4000; ++run) {
    std::vector<uint8_t> bytes(20 + random() % 200);
    for (uint8_t& byte : bytes) byte = uint8_t(random() >> 24);
    const LatticeCase latticeCase = decodeLattice(bytes.data(), bytes.size());
    const CutResult result = cut(latticeCase.mesh, latticeCase.grid, unresolved());
    INFO("run " << run);
    CHECK(result.error.status != Status::internalError);
    if (result.error.status != Status::selfIntersection) continue;
    ++refused;
    REQUIRE(result.error.element >= 0);
    REQUIRE(result.error.element < result.error.element2);
    CHECK(wholeMeet(latticeCase.triangles[size_t(result.error.element)], latticeCase.triangles[size_t(result.error.element2)]));
  }
  CHECK(refused > 50);
}
