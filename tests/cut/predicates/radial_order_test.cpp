// Predicate P6 against a direct evaluation of its definition in rational arithmetic.
#include "cut/predicates/radial_order.h"

#include "catch.h"
#include "exact_vectors.h"
#include "samples.h"

using namespace mandoline;
using namespace mandoline::detail;
using namespace exact_vectors;

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
