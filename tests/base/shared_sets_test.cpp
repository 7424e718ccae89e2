// Disjoint sets that several threads unite.
#include "base/shared_sets.h"

#include "base/disjoint_sets.h"
#include "base/team.h"
#include "catch.h"

using namespace mandoline;

TEST_CASE("shared sets: those that one thread finds, with the lowest item for each, whichever thread unites first") {
  const uint32_t count = 50'000;
  for (const size_t threads : {1, 2, 5}) {
    for (const uint32_t reach : {1u, 3u, 40'000u}) {  // chains, near ones, any
      std::vector<std::array<uint32_t, 2>> pairs;
      uint32_t random = reach;
      for (uint32_t i = 0; i < count; ++i) {
        random = random * 1664525 + 1013904223;
        if (random >> 28 != 0) pairs.push_back({i, (i + 1 + (random >> 8) % reach) % count});
      }
      detail::DisjointSets expected(count);
      for (const auto& [i, j] : pairs) expected.unite(i, j);
      detail::SharedSets sets(count);
      detail::runOnParts(threads, threads, [&](size_t thread) {
        for (size_t k = thread; k < pairs.size(); k += threads) sets.unite(pairs[k][0], pairs[k][1]);
      });
      for (uint32_t i = 0; i < count; ++i) REQUIRE(sets.find(i) == expected.find(i));
    }
  }
}
