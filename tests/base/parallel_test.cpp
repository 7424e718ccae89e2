#include "base/parallel.h"

#include <atomic>
#include <numeric>
#include <stdexcept>

#include "catch.h"
#include "mandoline/status.h"

using namespace mandoline;
using namespace mandoline::detail;

TEST_CASE("Of items that fail the lowest one's failure is thrown, in whatever order they come", "[parallel]") {
  std::vector<uint32_t> descending(100);
  for (uint32_t i = 0; i < 100; ++i) descending[i] = 99 - i;
  for (const unsigned threads : {1u, 2u, 5u}) {
    RunOptions options;
    options.threads = threads;
    Monitor monitor(options, 1);
    std::atomic<int> runs{0};
    const auto fail = [&](size_t, uint32_t item) {
      ++runs;
      if (item % 10 == 7) throw std::runtime_error(std::to_string(item));
    };
    CHECK_THROWS_WITH(runItems(descending, monitor, fail), "7");
    CHECK(runs >= 10);
  }
}

TEST_CASE("Each item runs once, and no two at once have the same thread's number", "[parallel]") {
  std::vector<uint32_t> items(1000);
  std::iota(items.begin(), items.end(), 0u);
  RunOptions options;
  options.threads = 4;
  size_t reports = 0;
  options.progress = [&](const Progress& progress) {
    ++reports;
    return progress.done <= progress.total;
  };
  Monitor monitor(options, 1);
  std::vector<std::atomic<int>> runs(items.size()), busy(4);
  std::atomic<bool> isShared = false;
  runItems(items, monitor, [&](size_t thread, uint32_t item) {
    if (++busy.at(thread) != 1) isShared = true;
    ++runs[item];
    --busy[thread];
  });
  CHECK_FALSE(isShared);
  for (const auto& count : runs) CHECK(count == 1);
  CHECK(reports == items.size());
}
