// Predicates P1 to P5 against a direct evaluation of their definitions in rational arithmetic: on random input, on input rounded onto
// grid lines, planes and each other, and on lattices, where ties are exact and common.
#include "catch.h"
#include "exact_cut.h"

using namespace mandoline;
using namespace mandoline::detail;
using namespace exact_vectors;

namespace {

/// The number beside a plane, toward another: next to 0, what is not taken as 0 when it is read again.
double beside(double plane, double toward) {
  return plane == 0 ? std::copysign(std::min(0x1p-80, std::fabs(toward) / 2), toward) : std::nextafter(plane, toward);
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
            if (!meetLine(corners, g, p) || !isInside(corners, g, p)) continue;
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
        REQUIRE(isInside(corners, g, cut.points[v]));
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
