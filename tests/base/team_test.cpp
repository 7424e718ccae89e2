// Threads that short loops share.
#include "base/team.h"

#include <atomic>
#include <vector>

#include "catch.h"

using namespace mandoline;

TEST_CASE("team: loops one after the other, each of whose items is done once, on any number of threads") {
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    const detail::Team team(threads);
#ifdef MANDOLINE_ONE_THREAD
    CHECK(team.size() == 1);
#else
    CHECK(team.size() == threads);
#endif
    std::vector<uint64_t> sums(100);
    uint64_t expected = 0;
    for (uint64_t loop = 0; loop < 2000; ++loop) {  // without locks: one loop must see what the one before has written
      std::atomic<size_t> next{0};
      team.run(1 + loop % (threads + 1), [&](size_t) {
        for (size_t i; (i = next++) < sums.size();) sums[i] += loop * i;
      });
      expected += loop;
    }
    for (size_t i = 0; i < sums.size(); ++i) REQUIRE(sums[i] == expected * i);
  }
}

TEST_CASE("team: who has begun is waited for") {
  const detail::Team team(4);
  for (int loop = 0; loop < 200; ++loop) {
    std::atomic<int> begun{0}, done{0};
    team.run(4, [&](size_t) {
      const int mine = begun++;
      for (int i = 0; mine > 0 && i < 10; ++i) detail::yieldThread();
      ++done;
    });
    CHECK(done == begun);
  }
}

TEST_CASE("team: a call during another one is done by who calls") {
  const detail::Team team(3);
  for (int loop = 0; loop < 200; ++loop) {
    std::atomic<int> next{0}, inner{0}, calls{0};
    team.run(3, [&](size_t) {
      while (next++ < 4) {
        ++calls;
        team.run(3, [&](size_t) { ++inner; });
      }
    });
    CHECK(calls == 4);
    CHECK(inner == 4);
  }
}

TEST_CASE("team: each thread has a number of its own, and the caller 0") {
  const detail::Team team(3);
  for (int loop = 0; loop < 200; ++loop) {
    std::vector<std::atomic<int>> calls(3), busy(3);
    std::atomic<bool> isShared = false;
    team.run(3, [&](size_t thread) {
      ++calls.at(thread);
      if (++busy[thread] != 1) isShared = true;
      for (int i = 0; i < 10; ++i) detail::yieldThread();
      --busy[thread];
    });
    CHECK(calls[0] == 1);
    CHECK_FALSE(isShared);
  }
}
