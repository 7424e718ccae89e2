#include "base/ranked_set.h"

#include <random>
#include <set>

#include "catch.h"

using mandoline::detail::RankedSet;

TEST_CASE("ranked set: numbers near each other and far apart, against std::set", "[rankedset]") {
  std::mt19937_64 random(7);
  std::set<uint64_t> expected{0, 63, 64, uint64_t(1) << 57};
  for (int i = 0; i < 3000; ++i) expected.insert((random() >> (random() % 60)) >> 6);
  std::vector<uint64_t> shuffled(expected.begin(), expected.end());
  std::shuffle(shuffled.begin(), shuffled.end(), random);

  RankedSet set;
  for (const uint64_t number : shuffled) set.insert(number);
  set.insert(shuffled[0]);  // twice
  set.rank();

  REQUIRE(set.size() == expected.size());
  uint32_t rank = 0;
  for (const uint64_t number : expected) REQUIRE(set.rankOf(number) == rank++);
  for (const uint64_t number : expected) {
    if (!expected.count(number + 1)) REQUIRE(set.rankOf(number + 1) == RankedSet::kNone);
  }
  std::vector<uint64_t> all;
  set.forEach([&](uint64_t number) { all.push_back(number); });
  CHECK(std::equal(all.begin(), all.end(), expected.begin(), expected.end()));
}

TEST_CASE("ranked set: empty", "[rankedset]") {
  RankedSet set;
  set.rank();
  CHECK(set.size() == 0);
  CHECK(set.rankOf(0) == RankedSet::kNone);
}
