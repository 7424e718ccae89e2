#include "base/ranked_set.h"

#include <random>
#include <set>

#include "catch.h"

using mandoline::detail::RankedSet;

namespace {

void requireSameAs(const std::set<uint64_t>& expected, RankedSet set) {
  std::vector<uint64_t> shuffled(expected.begin(), expected.end());
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(7));
  for (const uint64_t number : shuffled) set.insert(number);
  set.insert(shuffled[0]);  // twice
  set.rank();

  REQUIRE(set.size() == expected.size());
  uint32_t rank = 0;
  for (const uint64_t number : expected) REQUIRE(set.rankOf(number) == rank++);
  for (const uint64_t number : expected) {
    if (number < *expected.rbegin() && !expected.count(number + 1)) REQUIRE(set.rankOf(number + 1) == RankedSet::kNone);
  }
  std::vector<uint64_t> all;
  set.forEach([&](uint64_t number) { all.push_back(number); });
  CHECK(std::equal(all.begin(), all.end(), expected.begin(), expected.end()));
}

}  // namespace

TEST_CASE("ranked set: numbers near each other and far apart, against std::set", "[rankedset]") {
  std::mt19937_64 random(7);
  std::set<uint64_t> expected{0, 63, 64, uint64_t(1) << 57};
  for (int i = 0; i < 3000; ++i) expected.insert((random() >> (random() % 60)) >> 6);
  requireSameAs(expected, RankedSet());
  requireSameAs(expected, RankedSet((uint64_t(1) << 57) + 1, 3000));
}

TEST_CASE("ranked set: numbers below a limit, with a hash table and without", "[rankedset]") {
  std::mt19937_64 random(8);
  for (const uint64_t limit : {1u, 63u, 64u, 65u, 1000u}) {
    std::set<uint64_t> expected{limit - 1};
    for (uint64_t i = 0; i < limit / 2; ++i) expected.insert(random() % limit);
    for (const size_t most : {size_t(0), size_t(limit / 64), size_t(limit / 64 + 1)}) requireSameAs(expected, RankedSet(limit, most));
  }
}

TEST_CASE("ranked set: empty", "[rankedset]") {
  for (RankedSet set : {RankedSet(), RankedSet(100, 2)}) {
    set.rank();
    CHECK(set.size() == 0);
    CHECK(set.rankOf(0) == RankedSet::kNone);
  }
}
