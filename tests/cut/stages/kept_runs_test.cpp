// Ranges of numbers that are the same as before, and what is between them.
#include "cut/stages/kept_runs.h"

#include "catch.h"

using mandoline::detail::KeptRuns;

namespace {

using Range = std::pair<size_t, size_t>;

std::vector<Range> others(const KeptRuns& kept, size_t first, size_t past) {
  std::vector<Range> ranges;
  kept.forOthers(first, past, [&](size_t begin, size_t end) { ranges.push_back({begin, end}); });
  return ranges;
}

}  // namespace

TEST_CASE("Kept runs: what is not kept of a range", "[stages]") {
  const KeptRuns kept{{{2, 10, 3}, {5, 20, 1}, {8, 30, 2}}};  // 2 to 4, 5, and 8 and 9
  CHECK(others(kept, 0, 12) == std::vector<Range>{{0, 2}, {6, 8}, {10, 12}});
  CHECK(others(kept, 2, 6).empty());
  CHECK(others(kept, 3, 9) == std::vector<Range>{{6, 8}});
  CHECK(others(kept, 6, 8) == std::vector<Range>{{6, 8}});
  CHECK(others(kept, 7, 7).empty());
  CHECK(others(kept, 3, 3).empty());
  CHECK(others(kept, 9, 11) == std::vector<Range>{{10, 11}});
  CHECK(others(kept, 10, 11) == std::vector<Range>{{10, 11}});
  CHECK(others({}, 3, 5) == std::vector<Range>{{3, 5}});
}

TEST_CASE("Kept runs: all ranges have what is kept and what is not, each once and in order", "[stages]") {
  const KeptRuns kept{{{1, 7, 2}, {3, 0, 1}, {6, 40, 3}, {11, 50, 1}}};
  std::vector<int64_t> before(13, -1);  // per number
  for (const KeptRuns::Run& run : kept.runs) {
    for (uint32_t i = 0; i < run.count; ++i) before[run.first + i] = run.before + i;
  }
  for (size_t first = 0; first < before.size(); ++first) {
    for (size_t past = first + 1; past <= before.size(); ++past) {
      std::vector<int64_t> found(past - first, -2);
      kept.forKept(first, past, [&](const KeptRuns::Run& part) {
        REQUIRE((part.count > 0 && part.first >= first && part.past() <= past));
        for (uint32_t i = 0; i < part.count; ++i) found[part.first + i - first] = part.before + i;
      });
      size_t last = first;
      kept.forOthers(first, past, [&](size_t begin, size_t end) {
        REQUIRE((begin >= last && begin < end && end <= past));
        last = end;
        for (size_t i = begin; i < end; ++i) REQUIRE(std::exchange(found[i - first], -1) == -2);
      });
      CHECK(found == std::vector<int64_t>(before.begin() + ptrdiff_t(first), before.begin() + ptrdiff_t(past)));
    }
  }
}
